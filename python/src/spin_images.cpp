// Spin images of points in arrays, written straight into the array that Python gets.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "arrays.h"
#include "bindings.h"
#include "settings.h"
#include "work.h"

namespace py = pybind11;

namespace spincat::python {
namespace {

constexpr double kUnitTolerance = 2e-5;                   // of the square of a normal's length, and it counts as 1
constexpr std::size_t kLotBytes = std::size_t{16} << 20;  // of images, between which progress is told

// Points that single precision can hold, and how they came there.
class Frame {
 public:
  // Points further away from the origin than this, in extents of theirs, would lose more than a millionth of one.
  static constexpr double kFar = 8.0;

  explicit Frame(const Matrix& points) {
    if (points.is_single()) {
      return;
    }
    const double limit = std::numeric_limits<double>::infinity();
    Vec3 low = Vec3::Constant(limit);
    Vec3 high = Vec3::Constant(-limit);
    for (std::size_t i = 0; i < points.rows(); ++i) {
      if (const Vec3 p = points.vector(i); p.allFinite()) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
      }
    }
    const Vec3 middle = low + (high - low) / 2.0;
    if (middle.allFinite() && middle.cwiseAbs().maxCoeff() > kFar * (high - low).maxCoeff()) {
      origin_ = middle;
    }
  }

  Eigen::Vector3f operator()(const Vec3& point) const { return (point - origin_).cast<float>(); }

 private:
  Vec3 origin_ = Vec3::Zero();
};

// The normal with length 1; as it is where it has that already. None where it has no direction.
std::optional<Eigen::Vector3f> unit_normal(const Vec3& normal) {
  if (std::abs(normal.squaredNorm() - 1.0) <= kUnitTolerance) {
    return normal.cast<float>();
  }
  const double length = normal.stableNorm();
  if (!std::isfinite(length) || !(length > 0.0)) {
    return std::nullopt;
  }
  return normal.stableNormalized().cast<float>();
}

// The rows of two arrays that are oriented points, and which rows these are.
struct Kept {
  OrientedPoints points;
  std::vector<std::int64_t> rows;     // of points; empty where none was dropped
  std::vector<std::int64_t> dropped;  // not finite, or without a direction
};

OrientedPoints first_points(const OrientedPoints& points, std::size_t count) {
  OrientedPoints first(count);
  for (std::size_t k = 0; k < count; ++k) {
    first.set(k, points.position(k), points.normal(k));
  }
  return first;
}

// The rows of two packed arrays of three columns, as they are. False where one of them is not finite or has a normal of
// another length than 1: then not all are written.
bool copy_rows(const Matrix& positions, const Matrix& normals, OrientedPoints& points) {
  for (std::size_t i = 0; i < positions.rows(); ++i) {
    std::array<float, 3> p{};
    std::array<float, 3> n{};
    std::memcpy(p.data(), positions.bytes() + i * sizeof p, sizeof p);
    std::memcpy(n.data(), normals.bytes() + i * sizeof n, sizeof n);
    const double length = Vec3(n[0], n[1], n[2]).squaredNorm();
    const float nothing = (p[0] - p[0]) + (p[1] - p[1]) + (p[2] - p[2]);  // NaN where one is not finite
    if (!(std::abs(length - 1.0) <= kUnitTolerance && nothing == 0.0F)) {
      return false;
    }
    points.set(i, {p[0], p[1], p[2]}, {n[0], n[1], n[2]});
  }
  return true;
}

Kept oriented(const Matrix& positions, const Matrix& normals, std::size_t normal_column, const Frame& frame) {
  OrientedPoints found(positions.rows());
  Kept kept;
  // What most people bring, in a fifth of the time. The frame of single floats is their own.
  if (normal_column == 0 && positions.is_packed() && normals.is_packed() && copy_rows(positions, normals, found)) {
    kept.points = std::move(found);
    return kept;
  }
  std::size_t count = 0;
  for (std::size_t i = 0; i < positions.rows(); ++i) {
    const Eigen::Vector3f position = frame(positions.vector(i));
    const auto normal = unit_normal(normals.vector(i, normal_column));
    if (position.allFinite() && normal) {
      found.set(count++, position, *normal);
      if (!kept.dropped.empty()) {
        kept.rows.push_back(static_cast<std::int64_t>(i));
      }
    } else {
      if (kept.dropped.empty()) {
        kept.rows.resize(count);
        std::iota(kept.rows.begin(), kept.rows.end(), std::int64_t{0});
      }
      kept.dropped.push_back(static_cast<std::int64_t>(i));
    }
  }
  kept.points = kept.dropped.empty() ? std::move(found) : first_points(found, count);
  return kept;
}

// Which of an array's points the images are of.
std::vector<std::int64_t> chosen_rows(const py::handle& keypoints, std::size_t points) {
  const py::array array = any_array(keypoints, "keypoints", "indices");
  if (array.ndim() != 1 || array.dtype().kind() == 'f') {
    throw InputError("keypoints: expected indices, or points and normals of shape (K, 6), found " + shape_text(array) +
                     " of type " + py::str(py::object(array.dtype())).cast<std::string>());
  }
  const py::array_t<std::int64_t, py::array::c_style | py::array::forcecast> indices(array);
  std::vector<std::int64_t> rows(indices.data(), indices.data() + indices.size());
  for (const std::int64_t row : rows) {
    if (row < 0 || static_cast<std::uint64_t>(row) >= points) {
      throw InputError("keypoints: " + std::to_string(row) + " is no index of " + std::to_string(points) + " points");
    }
  }
  return rows;
}

Kept chosen(const std::vector<std::int64_t>& wanted, const Kept& surface, std::size_t points) {
  Kept kept;
  if (surface.dropped.empty()) {
    kept.points = OrientedPoints(wanted.size());
    for (std::size_t k = 0; k < wanted.size(); ++k) {
      const auto at = static_cast<std::size_t>(wanted[k]);
      kept.points.set(k, surface.points.position(at), surface.points.normal(at));
    }
    return kept;
  }
  std::vector<std::int64_t> place(points, -1);  // of a row among the points that were kept
  for (std::size_t k = 0; k < surface.rows.size(); ++k) {
    place[static_cast<std::size_t>(surface.rows[k])] = static_cast<std::int64_t>(k);
  }
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const bool is_there = place[static_cast<std::size_t>(wanted[i])] >= 0;
    (is_there ? kept.rows : kept.dropped).push_back(static_cast<std::int64_t>(i));
  }
  kept.points = OrientedPoints(kept.rows.size());
  for (std::size_t k = 0; k < kept.rows.size(); ++k) {
    const std::int64_t row = wanted[static_cast<std::size_t>(kept.rows[k])];
    const auto at = static_cast<std::size_t>(place[static_cast<std::size_t>(row)]);
    kept.points.set(k, surface.points.position(at), surface.points.normal(at));
  }
  return kept;
}

// How many images are asked for, told before anything is copied: it may be any number.
std::size_t count_of(const py::handle& keypoints, std::size_t points) {
  if (keypoints.is_none()) {
    return points;
  }
  const py::array array = any_array(keypoints, "keypoints", "indices, or points and normals of shape (K, 6)");
  return array.ndim() == 0 ? 0 : static_cast<std::size_t>(array.shape(0));
}

Kept spin_points(const py::handle& keypoints, const Kept& surface, std::size_t points, const Frame& frame) {
  if (keypoints.is_none()) {
    return surface;
  }
  if (py::array::ensure(keypoints).ndim() == 2) {
    const Matrix own(keypoints, "keypoints", 6);
    return oriented(own, own, 3, frame);
  }
  return chosen(chosen_rows(keypoints, points), surface, points);
}

SpinImageParams params_of(const py::dict& wanted, double bin_size) {
  Settings settings = preset("paper");
  settings.spin.support_angle = 180.0;
  for (const auto& [name, value] : wanted) {
    const auto key = name.cast<std::string>();
    set_setting(settings, find_setting(key), py::str(value).cast<std::string>(), key);
  }
  settings.spin.bin_size = bin_size;
  settings.spin.validate();
  return settings.spin;
}

// Writes the images of all spin points to `images`.
void make_images(const Kept& surface, const Kept& spins, const SpinImageParams& params, int threads, float* images,
                 Telling& telling) {
  const SpinImageMaker maker(surface.points, params, threads);
  const std::size_t size = params.shape().size();
  const std::size_t lot = std::max<std::size_t>(kSpinImageBlock, kLotBytes / (size * sizeof(float)));
  const std::size_t all = spins.points.size();
  for (std::size_t first = 0; first < all; first += lot) {
    const std::size_t count = std::min(lot, all - first);
    maker.make(spins.points, first, {images + first * size, count * size}, threads);
    telling("making spin images", first + count, all);
  }
}

// Moves the images that were made, which stand at the beginning, to their rows, and fills the others with NaN.
void spread_rows(const Kept& spins, std::size_t size, float* images) {
  if (spins.dropped.empty()) {
    return;
  }
  std::size_t made = spins.rows.size();
  for (std::size_t row = spins.rows.size() + spins.dropped.size(); row-- > 0;) {
    float* const to = images + row * size;
    if (made > 0 && spins.rows[made - 1] == static_cast<std::int64_t>(row)) {
      --made;
      if (made != row) {
        std::copy_n(images + made * size, size, to);
      }
    } else {
      std::fill_n(to, size, std::numeric_limits<float>::quiet_NaN());
    }
  }
}

py::array_t<float> empty_images(std::size_t count, const SpinImageShape& shape) {
  check_memory(static_cast<double>(count) * static_cast<double>(shape.size() * sizeof(float)), "spin images");
  std::vector<py::ssize_t> sizes = {static_cast<py::ssize_t>(count)};
  if (shape.channels > 1) {
    sizes.push_back(static_cast<py::ssize_t>(shape.channels));
  }
  sizes.push_back(static_cast<py::ssize_t>(shape.rows));
  sizes.push_back(static_cast<py::ssize_t>(shape.columns));
  return py::array_t<float>(sizes);
}

py::tuple spin_images(const py::object& points, const py::object& normals, const py::object& keypoints,
                      const py::dict& wanted, double bin_size, int threads, const py::object& progress) {
  threads_of(threads);
  const SpinImageParams params = params_of(wanted, bin_size);
  const Matrix positions(points, "points", 3);
  const Matrix directions(normals, "normals", 3);
  if (directions.rows() != positions.rows()) {
    throw InputError("normals: expected one for each of " + std::to_string(positions.rows()) + " points, found " +
                     std::to_string(directions.rows()));
  }
  py::array_t<float> images = empty_images(count_of(keypoints, positions.rows()), params.shape());
  check_memory(static_cast<double>(positions.rows()) * 64.0, "points");
  const Frame frame(positions);
  const Kept surface = oriented(positions, directions, 0, frame);
  if (surface.points.empty()) {
    throw InputError("points: expected one point or more that is finite and has a normal, found none");
  }
  const Kept spins = spin_points(keypoints, surface, positions.rows(), frame);
  float* const data = images.mutable_data();
  run_on_thread(progress, [&](Telling& telling) {
    make_images(surface, spins, params, threads, data, telling);
    spread_rows(spins, params.shape().size(), data);
  });
  return py::make_tuple(images, array_of(surface.dropped), array_of(spins.dropped));
}

}  // namespace

void bind_spin_images(py::module_& module) {
  module.def("spin_images", &spin_images);
  module.def("pcl_bin_size", &pcl_bin_size);
}

}  // namespace spincat::python
