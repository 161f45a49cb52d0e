#include "app/commands/spin_points.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "spincat/error.h"
#include "spincat/files/paths.h"
#include "spincat/geometry/left_out.h"
#include "spincat/io/npy.h"
#include "spincat/prepare/normalise.h"

namespace spincat::app {
namespace {

PointCloud as_points(const Object& object) {
  if (const auto* cloud = std::get_if<PointCloud>(&object)) {
    return *cloud;
  }
  Mesh mesh = without_unused_vertices(std::get<Mesh>(object));
  return {std::move(mesh.vertices), {}, {}, std::move(mesh.left_out)};
}

Vec3 vector_at(const NumberTable& table, std::size_t row, std::size_t first_column) {
  return {table.at(row, first_column), table.at(row, first_column + 1), table.at(row, first_column + 2)};
}

bool has_direction(const Vec3& vector) {
  return vector.allFinite() && !vector.isZero(0.0);
}

std::size_t index_at(const NumberTable& table, std::size_t row, std::size_t points) {
  const double value = table.at(row, 0);
  if (!(value >= 0.0 && value < static_cast<double>(points)) || value != std::floor(value)) {
    throw InputError(fmt::format("row {}: {} is no index of {} points", row, value, points));
  }
  return static_cast<std::size_t>(value);
}

SpinPoints points_at(const NumberTable& indices, const PreparedObject& object, std::size_t points_in_file) {
  if (object.surface_rows.empty()) {
    throw InputError("holds indices, which need --surface vertices: other surfaces are of drawn points");
  }
  SpinPoints chosen{OrientedPoints(indices.rows), {}};
  for (std::size_t k = 0; k < indices.rows; ++k) {
    const std::size_t row = index_at(indices, k, points_in_file);
    const auto found = std::ranges::lower_bound(object.surface_rows, row);
    if (found == object.surface_rows.end() || *found != row) {
      throw InputError(fmt::format(
          "row {}: point {} has no image: it is not finite, repeats another, stands alone or is part of no face", k,
          row));
    }
    const auto i = static_cast<std::size_t>(found - object.surface_rows.begin());
    chosen.points.set(k, object.surface.position(i), object.surface.normal(i));
    chosen.rows.push_back(*found);
  }
  return chosen;
}

SpinPoints own_points(const NumberTable& table, const PreparedObject& object) {
  SpinPoints own{OrientedPoints(table.rows), {}};
  for (std::size_t k = 0; k < table.rows; ++k) {
    const Vec3 position = vector_at(table, k, 0);
    const Vec3 axis = vector_at(table, k, 3);
    if (!position.allFinite() || !has_direction(axis)) {
      throw InputError(fmt::format("row {}: expected a point and a normal, found {} {} {} and {} {} {}", k, position[0],
                                   position[1], position[2], axis[0], axis[1], axis[2]));
    }
    own.points.set(k, ((position - object.centre) * object.scale).cast<float>(), axis.stableNormalized().cast<float>());
  }
  return own;
}

}  // namespace

PointCloud with_normals(const Object& object, const std::filesystem::path& file) {
  const PointCloud given = as_points(object);
  const NumberTable table = read_npy(file);
  return naming_file(file, [&] {
    const std::size_t in_file = points_in_file(given);
    const bool is_of_kept = table.rows == given.points.size();
    if (table.columns != 3 || (!is_of_kept && table.rows != in_file)) {
      throw InputError(fmt::format("holds an array of {} x {}; expected a normal for each of {} points: {} x 3",
                                   table.rows, table.columns, in_file, in_file));
    }
    PointCloud cloud{{}, {}, given.sensor, given.left_out};
    const std::vector<std::uint32_t> rows = rows_of_kept(given.points.size(), given.left_out);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const Vec3 normal = vector_at(table, is_of_kept ? i : rows[i], 0);
      if (has_direction(normal)) {
        cloud.points.push_back(given.points[i]);
        cloud.normals.push_back(normal);
      } else {
        cloud.left_out.push_back(rows[i]);
      }
    }
    if (cloud.points.empty()) {
      throw InputError("holds no normal that is finite and not zero");
    }
    std::ranges::sort(cloud.left_out);
    return cloud;
  });
}

std::size_t points_in_file(const Object& object) {
  if (const auto* mesh = std::get_if<Mesh>(&object)) {
    return mesh->vertices.size() + mesh->left_out.size();
  }
  const auto& cloud = std::get<PointCloud>(object);
  return cloud.points.size() + cloud.left_out.size();
}

SpinPoints read_keypoints(const std::filesystem::path& file, const PreparedObject& object, std::size_t points_in_file) {
  const NumberTable table = read_npy(file);
  return naming_file(file, [&] {
    if (table.rows == 0) {
      throw InputError("holds no keypoint");
    }
    if (table.columns == 1) {
      return points_at(table, object, points_in_file);
    }
    if (table.columns != 6) {
      throw InputError(fmt::format("holds an array of {} x {}; expected indices, or points and normals: K x 6",
                                   table.rows, table.columns));
    }
    return own_points(table, object);
  });
}

}  // namespace spincat::app
