// One front door for reading an object from a file, whatever its format.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "spincat/geometry/object.h"

namespace spincat {

// Limits while reading, so that a damaged or hostile file cannot take the machine down.
struct ReadLimits {
  std::size_t max_points = 100'000'000;     // vertices or points
  std::size_t max_triangles = 200'000'000;  // after polygons are cut into triangles
};

// Reads an OFF, OBJ, PLY, STL, PCD, XYZ, glTF or GLB file; the extension decides, upper or lower case.
// Polygons become fans of triangles. A file with vertices but no faces becomes a PointCloud. glTF nodes are placed by
// their transforms. Deterministic.
// Throws InputError (file, and the line where there are lines) when the file is missing, damaged, of another format, or
// holds neither a face nor a point; a spincat model handed in by mistake is recognised and named as such.
Object read_object(const std::filesystem::path& file, const ReadLimits& limits = {});

// Whether read_object knows this file's extension.
bool is_object_file(const std::filesystem::path& file);

// The extensions that read_object knows, in lower case with their dot.
const std::vector<std::string>& object_extensions();

}  // namespace spincat
