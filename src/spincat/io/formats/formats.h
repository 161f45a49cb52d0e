// The readers behind read_object, one file a format. Private to io.
//
// Each is handed the whole file and throws InputError without the file's name, which read_object adds. All of them keep
// to the same promises: every count is bounded by the bytes left before memory is taken for it, memory stays within
// ReadLimits::max_growth times the file and 16 MB, time grows with the file's
// size, and the outcome does not depend on the locale. What they build goes through ObjectBuilder, which checks the
// rest.
#pragma once

#include <filesystem>
#include <string_view>

#include "spincat/geometry/object.h"
#include "spincat/io/read_object.h"

namespace spincat::io {

Object read_off(std::string_view bytes, const ReadLimits& limits);
Object read_obj(std::string_view bytes, const ReadLimits& limits);
Object read_ply(std::string_view bytes, const ReadLimits& limits);
Object read_stl(std::string_view bytes, const ReadLimits& limits);
Object read_pcd(std::string_view bytes, const ReadLimits& limits);
Object read_xyz(std::string_view bytes, const ReadLimits& limits);

// glTF and GLB. Its buffers may lie in files of their own, in or below `folder`, where the file itself lies.
Object read_gltf(std::string_view bytes, const std::filesystem::path& folder, const ReadLimits& limits);

}  // namespace spincat::io
