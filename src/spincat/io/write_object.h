// An object into a file that other programs read, too.
#pragma once

#include <filesystem>

#include "spincat/geometry/object.h"

#pragma GCC visibility push(default)
namespace spincat {

// Writes a mesh as a PLY file, a cloud as a PLY or PCD file; the extension decides, upper or lower case. Binary, with
// coordinates in double precision, so that read_object gives back the same object, bit for bit. The place of a sensor
// is kept by PCD alone. Beside the target first, then renamed. The same object gives the same bytes. Throws InputError
// when the extension is another, or the format cannot hold the object; RunError when the file cannot be written.
// Precondition: the object has a point, and all coordinates are finite.
void write_object(const std::filesystem::path& file, const Object& object);

}  // namespace spincat
#pragma GCC visibility pop
