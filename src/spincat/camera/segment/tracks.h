// Objects followed from frame to frame.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "spincat/camera/segment/scene.h"

namespace spincat {

// Follows objects by their positions over the table: each is taken to be the nearest of those of the frame before, the
// closest pairs first, expected where it would be if it went on as before. Deterministic.
class Tracks {
 public:
  explicit Tracks(const TrackSettings& settings = {}) : settings_(settings) {}

  // The tracks of a frame's objects, given their centres in metres, in the order of the centres. Numbers count from 1
  // and are never used again.
  std::vector<std::uint64_t> follow(std::span<const Eigen::Vector3f> centres);

  // Those that were forgotten at the last call of follow: what was kept for them may go.
  const std::vector<std::uint64_t>& forgotten() const { return forgotten_; }

 private:
  struct Track {
    std::uint64_t id = 0;
    Eigen::Vector3f centre;
    Eigen::Vector3f step;  // from the frame before to this one
    int missing = 0;       // frames since it was seen
  };

  TrackSettings settings_;
  std::vector<Track> tracks_;
  std::vector<std::uint64_t> forgotten_;
  std::uint64_t next_ = 1;
};

}  // namespace spincat
