// One front door for reading an object from a file, whatever its format.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "spincat/geometry/object.h"
#include "spincat/io/read_limits.h"

#pragma GCC visibility push(default)
namespace spincat {

// Reads an OFF, OBJ, PLY, STL, PCD, XYZ, glTF, GLB, 3MF, NPY, NPZ or LAS file, or a KITTI scan (.bin). The extension
// decides, upper or lower case, unless the file begins plainly like one of another of these formats. XYZ files are also
// called .xyzn, .pts, .asc or .txt. Text may be in UTF-8 or UTF-16.
// Polygons become fans of triangles; faces of one or two corners are passed over. A file with vertices but no faces
// becomes a PointCloud, and its points that are not finite ("nothing measured") are left out; in a mesh they are an
// error where a face uses them. Equal vertices are merged in STL alone, where every triangle repeats its own. glTF
// nodes and 3MF items are placed by their transforms. The sensor is known from a PCD file's VIEWPOINT, unless that is
// the default (0 0 0 1 0 0 0), which most programs write when they know nothing. Deterministic.
// Throws RunError when the memory does not suffice, InputError (file, and the line where there are lines) when the file
// is missing, damaged, of another format, or holds neither a face nor a point; a spincat model handed in by mistake is
// recognised and named as such.
Object read_object(const std::filesystem::path& file, const ReadLimits& limits = {});

// The same for a file that a folder holds or a list names. It must be a regular file: nobody may ever write to a pipe
// of that name, and the others would wait for it.
Object read_listed_object(const std::filesystem::path& file, const ReadLimits& limits = {});

// Whether a file that somebody names may be an object: its extension is that of a format.
bool has_object_name(const std::filesystem::path& file);

// Whether a file in a folder of objects is meant as one: its extension is that of a format. Notes and lists are called
// .txt, too: such a file is meant where its first lines are rows of numbers; .bin may be anything and is not. Opens
// regular files called .txt only, and reads no more than their beginning.
bool is_object_file(const std::filesystem::path& file);

// The extensions of all formats (as above, so without .txt and .bin), in lower case with their dot.
const std::vector<std::string>& object_extensions();

}  // namespace spincat
#pragma GCC visibility pop
