// What the command `spin` takes from arrays: normals of an object's points, and the points to make images of.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "spincat/geometry/object.h"
#include "spincat/geometry/oriented_points.h"
#include "spincat/prepare/prepare.h"

namespace spincat::app {

// The points of an object, a mesh's vertices too, as a cloud whose normals are the rows of a .npy file (N x 3): one for
// each point of the object's file, or for each that is finite. Points without a direction (NaN, zero) are left out.
// Throws InputError that begins with the .npy file.
PointCloud with_normals(const Object& object, const std::filesystem::path& file);

// The points of an object's file, those left out as well.
std::size_t points_in_file(const Object& object);

// Points to make images of, as a prepared object has them.
struct SpinPoints {
  OrientedPoints points;
  std::vector<std::uint32_t> rows;  // which points of the file they are; empty: none of its
};

// The rows of a .npy file: indices of the points of the object's file (0: the first), or points of their own, K x 6, in
// the file's unit and with the axes of their images. Throws InputError that begins with the .npy file where an index is
// of no surface point, or a row no oriented point.
SpinPoints read_keypoints(const std::filesystem::path& file, const PreparedObject& object, std::size_t points_in_file);

}  // namespace spincat::app
