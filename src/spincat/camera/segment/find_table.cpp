#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "spincat/camera/segment/table.h"
#include "spincat/geometry/random.h"

namespace spincat {
namespace {

using Eigen::Vector3f;

constexpr int kStride = 4;                    // every fourth pixel both ways is looked at
constexpr std::size_t kScored = 2'500;        // of these, to score a plane
constexpr std::size_t kGlanced = 312;         // of these, to see whether a plane is worth scoring
constexpr std::size_t kFewestReadings = 300;  // of these
constexpr int kNear = 20;                     // of these, both ways: how far apart the readings of a close triple are
constexpr float kLeastCosine = 0.94F;         // of the angle between the plane's normal and up: 20 degrees
constexpr double kKeep = 1.2;                 // how much better another plane must be than that of the frame before
constexpr float kMostFacingDown = 0.2F;       // of a normal's part along the picture's rows, down, for a table
constexpr double kUnlikely = 0.1;             // what counts of the share of a plane that faces down
constexpr float kLeastDrop = 0.35F;           // metres from a table to the floor or a lower table
constexpr double kLeastOfFloor = 0.2;         // of the floor's share, for a table before it
constexpr double kLeastLevel = 0.02;          // share of a floor beyond a table
constexpr float kParallel = 0.99F;            // cosine of the angle between their normals: 8 degrees
constexpr double kPromising = 0.8;            // of the best plane's share at a glance

struct Reading {
  Vector3f point;
  float weight;
};

// Every kStride-th reading both ways, in rows.
class Readings {
 public:
  Readings(const DepthImage& image, const Intrinsics& intrinsics)
      : columns_((image.width + kStride - 1) / kStride), rows_((image.height + kStride - 1) / kStride) {
    index_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), kNone);
    for (int y = 0; y < rows_; ++y) {
      for (int x = 0; x < columns_; ++x) {
        if (const float z = image.at(x * kStride, y * kStride); z > 0.0F) {
          index_[place(x, y)] = static_cast<std::uint32_t>(all_.size());
          places_.push_back({x, y});
          all_.push_back({intrinsics.point(x * kStride, y * kStride, z), 1.0F / (z * z)});
        }
      }
    }
  }

  const std::vector<Reading>& all() const { return all_; }

  const Vector3f& any(Random& random) const { return all_[random.below(all_.size())].point; }

  // Three of them close together: they are more often of one surface than any three. Nothing where one is missing.
  std::optional<std::array<Vector3f, 3>> close_triple(Random& random) const {
    const std::size_t first = random.below(all_.size());
    std::array<Vector3f, 3> triple = {all_[first].point, {}, {}};
    for (std::size_t k = 1; k < 3; ++k) {
      const int x = places_[first].x + static_cast<int>(random.below(2 * kNear + 1)) - kNear;
      const int y = places_[first].y + static_cast<int>(random.below(2 * kNear + 1)) - kNear;
      if (x < 0 || y < 0 || x >= columns_ || y >= rows_ || index_[place(x, y)] == kNone) {
        return {};
      }
      triple[k] = all_[index_[place(x, y)]].point;
    }
    return triple;
  }

 private:
  static constexpr std::uint32_t kNone = 0xffff'ffff;
  struct Place {
    int x;
    int y;
  };
  std::size_t place(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(x);
  }

  int columns_;
  int rows_;
  std::vector<std::uint32_t> index_;  // of the reading at each place
  std::vector<Place> places_;         // of each reading
  std::vector<Reading> all_;
};

bool lies_on(const SupportPlane& table, const Reading& reading) {
  return std::abs(table.height(reading.point)) < plane_tolerance(reading.point.z());
}

// The share of the weight of every `step`-th reading that lies on the plane.
double share_on(const SupportPlane& table, const std::vector<Reading>& readings, std::size_t step) {
  double on = 0.0;
  double all = 0.0;
  for (std::size_t i = 0; i < readings.size(); i += step) {
    all += readings[i].weight;
    on += lies_on(table, readings[i]) ? readings[i].weight : 0.0F;
  }
  return on / all;
}

SupportPlane towards_camera(Vector3f normal, const Vector3f& point) {
  normal.normalize();
  const float offset = -normal.dot(point);
  return offset < 0.0F ? SupportPlane{-normal, -offset} : SupportPlane{normal, offset};
}

bool may_be_table(const SupportPlane& table, const TableSettings& settings) {
  return table.normal.allFinite() && (!settings.up || table.normal.dot(settings.up->normalized()) > kLeastCosine);
}

// The plane of least squares through every `step`-th reading on `table`.
SupportPlane refitted(const SupportPlane& table, const std::vector<Reading>& readings, std::size_t step) {
  double weight = 0.0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d products = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < readings.size(); i += step) {
    if (lies_on(table, readings[i])) {
      const Eigen::Vector3d p = readings[i].point.cast<double>();
      weight += readings[i].weight;
      sum += readings[i].weight * p;
      products += readings[i].weight * p * p.transpose();
    }
  }
  if (!(weight > 0.0)) {
    return table;
  }
  const Eigen::Vector3d mean = sum / weight;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(products / weight - mean * mean.transpose());
  return towards_camera(solver.eigenvectors().col(0).cast<float>(), mean.cast<float>());
}

// How much a plane's share counts. A wall may hold most readings; seen from a camera that is not upside down and looks
// down it faces down.
double likelihood(const SupportPlane& table, const TableSettings& settings) {
  return !settings.up && table.normal.y() > kMostFacingDown ? kUnlikely : 1.0;
}

// The best plane so far.
class Search {
 public:
  Search(const std::vector<Reading>& readings, const TableSettings& settings)
      : readings_(readings),
        settings_(settings),
        step_(std::max<std::size_t>(readings.size() / kScored, 1)),
        glance_(std::max<std::size_t>(readings.size() / kGlanced, 1)) {}

  // Takes the plane if it is better; then also refines it (locally optimised RANSAC, Chum, Matas and Kittler 2003).
  void consider(SupportPlane table, double favour = 1.0) {
    favour *= likelihood(table, settings_);
    if (!may_be_table(table, settings_) ||
        favour * share_on(table, readings_, glance_) < kPromising * best_at_glance_) {
      return;
    }
    for (int k = 0; k <= kRefits; ++k) {
      table.share = favour * share_on(table, readings_, step_);
      if (!(table.share > best_.share) || !may_be_table(table, settings_)) {
        return;
      }
      best_ = table;
      best_at_glance_ = favour * share_on(table, readings_, glance_);
      table = refitted(table, readings_, step_);
    }
  }

  const SupportPlane& best() const { return best_; }

 private:
  static constexpr int kRefits = 4;

  const std::vector<Reading>& readings_;
  const TableSettings& settings_;
  const std::size_t step_;
  const std::size_t glance_;
  SupportPlane best_;
  double best_at_glance_ = 0.0;
};

void consider_plane_of(const std::array<Vector3f, 3>& triple, Search& search) {
  const Vector3f normal = (triple[1] - triple[0]).cross(triple[2] - triple[0]);
  if (normal.norm() > 1e-6F) {
    search.consider(towards_camera(normal, triple[0]));
  }
}

// Trials after which a plane of such a share has been met but for one case in ten thousand (Fischler and Bolles), at
// least `least` and at most five times as many: the smaller the share of the best one, the likelier is a better.
int trials_for(double share, int least) {
  const double wanted = 9.2 / std::max(share * share * share, 1e-6);
  return static_cast<int>(std::clamp<double>(wanted, least, 5.0 * least));
}

// The plane of least squares through all readings on it.
SupportPlane finished(SupportPlane table, const std::vector<Reading>& readings) {
  constexpr int kRefits = 3;
  for (int k = 0; k < kRefits && table.share > 0.0; ++k) {
    table = refitted(table, readings, 1);
    table.share = share_on(table, readings, 1);
  }
  return table;
}

// The planes along `table` that are peaks among the readings' heights over it, hold a share of kLeastLevel or more and
// lie at least `drop` above or below it; from the lowest up.
std::vector<SupportPlane> levels_along(const SupportPlane& table, const std::vector<Reading>& readings, float drop) {
  constexpr float kBin = 0.02F;  // metres
  constexpr int kBins = 200;     // up and down
  std::vector<double> weights(2 * kBins + 1, 0.0);
  double all = 0.0;
  for (const Reading& reading : readings) {
    const float bin = std::round(table.height(reading.point) / kBin);
    all += reading.weight;
    if (std::abs(bin) <= kBins) {
      weights[static_cast<std::size_t>(static_cast<int>(bin) + kBins)] += reading.weight;
    }
  }
  std::vector<SupportPlane> levels;
  for (std::size_t bin = 1; bin + 1 < weights.size(); ++bin) {
    const float rise = kBin * static_cast<float>(static_cast<int>(bin) - kBins);
    const bool is_peak = weights[bin] >= weights[bin - 1] && weights[bin] > weights[bin + 1];
    if (is_peak && std::abs(rise) > 0.9F * drop &&
        weights[bin - 1] + weights[bin] + weights[bin + 1] > 0.5 * kLeastLevel * all) {
      SupportPlane level = table;
      level.offset -= rise;
      level.share = 1.0;
      level = finished(level, readings);
      if (level.normal.dot(table.normal) > kParallel && std::abs(table.offset - level.offset) > drop) {
        levels.push_back(level);
      }
    }
  }
  return levels;
}

// The table over the floor that was found, or the floor below the table, as the settings say.
SupportPlane other_level(const SupportPlane& found, const std::vector<Reading>& readings,
                         const TableSettings& settings) {
  // So far apart that no reading is of both.
  const float drop = std::max(kLeastDrop, 4.0F * plane_tolerance(found.offset));
  SupportPlane best = found;
  for (const SupportPlane& level : levels_along(found, readings, drop)) {
    const bool is_above = level.offset < found.offset;
    const bool is_seen = level.share >= settings.least_share;
    switch (settings.scene) {
      case SceneKind::automatic:
        best = is_above && is_seen && level.share >= kLeastOfFloor * found.share ? level : best;
        break;
      case SceneKind::table:
        best = is_above && is_seen ? level : best;
        break;
      case SceneKind::floor:
        if (!is_above && level.share >= kLeastLevel) {
          return level;  // the lowest comes first
        }
        break;
    }
  }
  return best;
}

}  // namespace

std::optional<SupportPlane> find_table(const DepthImage& image, const Intrinsics& intrinsics,
                                       const TableSettings& settings, const std::optional<SupportPlane>& before) {
  const Readings readings(image, intrinsics);
  if (readings.all().size() < kFewestReadings) {
    return {};
  }
  Search search(readings.all(), settings);
  if (before) {
    search.consider(*before, kKeep);
  }
  Random random(settings.seed);
  for (int trial = 0; trial < trials_for(search.best().share, settings.trials); ++trial) {
    if (const auto triple = readings.close_triple(random)) {
      consider_plane_of(*triple, search);
    }
    consider_plane_of({readings.any(random), readings.any(random), readings.any(random)}, search);
  }
  const SupportPlane best = other_level(finished(search.best(), readings.all()), readings.all(), settings);
  if (best.share < settings.least_share || !may_be_table(best, settings)) {
    return {};
  }
  return best;
}

}  // namespace spincat
