// One front door for reading an object from a file, whatever its format.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "spincat/geometry/object.h"
#include "spincat/io/read_limits.h"

#pragma GCC visibility push(default)
namespace spincat {

// Reads an OFF, OBJ, PLY, STL, PCD, XYZ, glTF, GLB, 3MF, NPY, NPZ or LAS file, or a KITTI scan (.bin); the extension
// decides, upper or lower case. XYZ files are also called .xyzn, .pts, .asc or .txt.
// Polygons become fans of triangles; faces of one or two corners are passed over. A file with vertices but no faces
// becomes a PointCloud, and its points that are not finite ("nothing measured") are left out; in a mesh they are an
// error. Equal vertices are merged in STL alone, where every triangle repeats its own. glTF nodes and 3MF items are
// placed by their transforms. The sensor is known from a PCD file's VIEWPOINT, unless that is the default (0 0 0 1 0 0 0), which most
// programs write when they know nothing. Deterministic.
// Throws RunError when the memory does not suffice, InputError (file, and the line where there are lines) when the file
// is missing, damaged, of another format, or holds neither a face nor a point; a spincat model handed in by mistake is
// recognised and named as such.
Object read_object(const std::filesystem::path& file, const ReadLimits& limits = {});

// The same for a file that a folder holds or a list names. It must be a regular file: nobody may ever write to a pipe
// of that name, and the others would wait for it.
Object read_listed_object(const std::filesystem::path& file, const ReadLimits& limits = {});

// Whether a file in a folder of objects is meant as one: its extension is that of a format and neither .txt (there,
// those are notes) nor .bin (anything).
bool is_object_file(const std::filesystem::path& file);

// The extensions of all formats (as above, so without .txt and .bin), in lower case with their dot.
const std::vector<std::string>& object_extensions();

}  // namespace spincat
#pragma GCC visibility pop
