#include "spincat/report/evidence_json.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>
#include <vector>

#include "spincat/report/shape_json.h"
#include "spincat/settings/setting_names.h"
#include "spincat/spin/spin_images.h"

namespace spincat {
namespace {

constexpr std::size_t kStrongest = 4;        // spin points whose images are shown, on either side
constexpr std::size_t kMostSpinDots = 2048;  // spin points of one part and draw that are drawn

float strongest_of(std::span<const float> values) {
  float strongest = 0.0F;
  for (const float value : values) {
    strongest = std::max(strongest, std::abs(value));
  }
  return strongest;
}

struct PlacedPoint {
  std::size_t part;
  std::size_t point;
  float value;
};

// Those that speak most for the winner, then those that speak most against it.
std::vector<PlacedPoint> strongest_points(const Evidence& evidence) {
  std::vector<PlacedPoint> all;
  for (std::size_t p = 0; p < evidence.parts.size(); ++p) {
    for (std::size_t k = 0; k < std::min(evidence.parts[p].of_point.size(), kMostSpinDots); ++k) {
      all.push_back({p, k, evidence.parts[p].of_point[k]});
    }
  }
  std::ranges::stable_sort(all, std::ranges::greater{}, &PlacedPoint::value);
  std::vector<PlacedPoint> strongest;
  for (std::size_t i = 0; i < std::min(kStrongest, all.size()) && all[i].value > 0.0F; ++i) {
    strongest.push_back(all[i]);
  }
  for (std::size_t i = 0; i < std::min(kStrongest, all.size()) && all[all.size() - 1 - i].value < 0.0F; ++i) {
    strongest.push_back(all[all.size() - 1 - i]);
  }
  return strongest;
}

// One channel with at most `most_rows` rows: each cell holds the sum of `by` x `by` bins, fewer at the end.
std::vector<float> reduced(std::span<const float> channel, const SpinImageShape& shape, std::size_t by) {
  const std::size_t columns = (shape.columns + by - 1) / by;
  std::vector<float> cells((shape.rows + by - 1) / by * columns, 0.0F);
  for (std::size_t bin = 0; bin < channel.size(); ++bin) {
    cells[bin / shape.columns / by * columns + bin % shape.columns / by] += channel[bin];
  }
  return cells;
}

// The square root makes sparse bins visible; each channel is scaled to its fullest bin.
Json image_json(const PlacedPoint& placed, const Preparation& preparation, std::size_t most_rows) {
  OrientedPoints point(1);
  const OrientedPoints& all = preparation.object.spin_points;
  point.set(0, all.position(placed.point), all.normal(placed.point));
  const SpinImages images = make_spin_images(preparation.object.surface, point, preparation.params);
  const SpinImageShape& shape = images.shape();
  const std::size_t by = (shape.rows + most_rows - 1) / most_rows;
  std::vector<std::uint8_t> greys;
  for (std::size_t c = 0; c < shape.channels; ++c) {
    const std::size_t size = shape.rows * shape.columns;
    const std::vector<float> cells = reduced(images.image(0).subspan(c * size, size), shape, by);
    const float fullest = std::max(*std::ranges::max_element(cells), 1e-30F);
    for (const float cell : cells) {
      greys.push_back(
          static_cast<std::uint8_t>(std::lround(255.0F * (1.0F - std::sqrt(std::max(cell, 0.0F) / fullest)))));
    }
  }
  return {{"part", placed.part},
          {"point", placed.point},
          {"value", placed.value},
          {"rows", (shape.rows + by - 1) / by},
          {"columns", (shape.columns + by - 1) / by},
          {"channels", shape.channels},
          {"values", base64(greys)}};
}

Json part_json(const PartEvidence& part) {
  const std::size_t shown = std::min(part.of_point.size(), kMostSpinDots);
  const std::span<const float> values(part.of_point.data(), shown);
  const float strongest = strongest_of(values);
  std::vector<std::int16_t> shares;
  for (const float value : values) {
    shares.push_back(short_number(strongest > 0.0F ? value / strongest : 0.0F));
  }
  const OrientedPoints& points = part.prepared.preparation.object.spin_points;
  return {{"surface", name_of(part.prepared.surface)},
          {"axes", name_of(part.prepared.axes)},
          {"spin_points", points.size()},
          {"points", base64_positions(points, shown)},
          {"strongest", strongest},
          {"values", base64_of<std::int16_t>(shares)}};
}

}  // namespace

Json margins_json(const Ballot& ballot) {
  std::vector<float> margins;
  for (const Vote& vote : ballot.votes) {
    margins.push_back(vote.margin);
  }
  double per_unit = 1000.0;
  while (static_cast<double>(strongest_of(margins)) * per_unit > 32767.0) {
    per_unit /= 10.0;
  }
  std::vector<std::int16_t> values;
  for (const float margin : margins) {
    values.push_back(static_cast<std::int16_t>(std::lround(static_cast<double>(margin) * per_unit)));
  }
  return {{"unit", 1.0 / per_unit}, {"values", base64_of<std::int16_t>(values)}};
}

Json evidence_json(const Evidence& evidence, std::size_t image_rows) {
  Json parts = Json::array();
  for (const PartEvidence& part : evidence.parts) {
    parts.push_back(part_json(part));
  }
  Json images = Json::array();
  for (const PlacedPoint& placed : strongest_points(evidence)) {
    images.push_back(image_json(placed, evidence.parts[placed.part].prepared.preparation, image_rows));
  }
  return {{"kind", evidence.kind == EvidenceKind::shares ? "shares" : "leaving-out"},
          {"winner", evidence.winner},
          {"runner_up", evidence.runner_up},
          {"margin", evidence.margin},
          {"parts", parts},
          {"images", images}};
}

}  // namespace spincat
