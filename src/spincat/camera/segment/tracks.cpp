#include "spincat/camera/segment/tracks.h"

#include <algorithm>
#include <cstddef>
#include <tuple>

namespace spincat {

std::vector<std::uint64_t> Tracks::follow(std::span<const Eigen::Vector3f> centres) {
  // All pairs that are near enough, the closest first.
  std::vector<std::tuple<float, std::size_t, std::size_t>> pairs;
  for (std::size_t t = 0; t < tracks_.size(); ++t) {
    const auto frames = static_cast<float>(tracks_[t].missing + 1);
    const Eigen::Vector3f expected = tracks_[t].centre + frames * tracks_[t].step;
    for (std::size_t k = 0; k < centres.size(); ++k) {
      const float distance = (centres[k] - expected).norm();
      if (distance <= settings_.most_step) {
        pairs.emplace_back(distance, t, k);
      }
    }
  }
  std::ranges::sort(pairs);
  std::vector<std::uint64_t> ids(centres.size(), 0);
  for (Track& track : tracks_) {
    ++track.missing;
  }
  for (const auto& [distance, t, k] : pairs) {
    Track& track = tracks_[t];
    if (ids[k] != 0 || track.missing == 0) {
      continue;
    }
    track.step = (centres[k] - track.centre) / static_cast<float>(track.missing);
    track.centre = centres[k];
    track.missing = 0;
    ids[k] = track.id;
  }
  for (std::size_t k = 0; k < centres.size(); ++k) {
    if (ids[k] == 0) {
      ids[k] = next_++;
      tracks_.push_back({ids[k], centres[k], Eigen::Vector3f::Zero(), 0});
    }
  }
  forgotten_.clear();
  std::erase_if(tracks_, [&](const Track& track) {
    const bool forget = track.missing > settings_.most_missing;
    if (forget) {
      forgotten_.push_back(track.id);
    }
    return forget;
  });
  return ids;
}

}  // namespace spincat
