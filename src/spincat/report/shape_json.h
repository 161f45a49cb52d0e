// Objects as pages draw them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "spincat/geometry/object.h"
#include "spincat/geometry/oriented_points.h"
#include "spincat/prepare/prepare.h"
#include "spincat/report/base64.h"
#include "spincat/report/json_parts.h"

namespace spincat {

// Positions are 16-bit numbers of which 32767 is 2: prepared points lie within 1, but a corner that no point came near
// may lie beyond. In a normal 32767 is 1.

// {"points": 3 n 16-bit numbers, "triangles": 3 m 16-bit indices, "of": triangles or points of the object}.
// A mesh that needs more than about `most_bytes` is simplified (meshoptimizer), a cloud (without "triangles") thinned
// evenly. In the frame of the prepared object.
Json shape_json(const Object& object, const PreparedObject& prepared, std::size_t most_bytes);

// The corners of those triangles, 9 numbers each, of the first `most`.
std::string base64_triangles(const Mesh& mesh, std::span<const std::uint32_t> triangles, const PreparedObject& prepared,
                             std::size_t most);

// Positions of the first `count` points, which lie in the frame; the same of their normals.
std::string base64_positions(const OrientedPoints& points, std::size_t count);
std::string base64_normals(const OrientedPoints& points, std::size_t count);

}  // namespace spincat
