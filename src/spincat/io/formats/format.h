// What read_object knows of a file format; each has a file here and a line in formats.inc. Private to io.
//
// A reader is handed the whole file and throws InputError without the file's name, which read_object adds. All of them
// keep to the same promises: every count is bounded by the bytes left before memory is taken for it, memory stays
// within ReadLimits::max_growth times the file and 16 MB, time grows with the file's size, and the outcome does not
// depend on the locale. What they build goes through ObjectBuilder, which checks the rest.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

#include "spincat/geometry/object.h"
#include "spincat/io/formats/likeness.h"
#include "spincat/io/read_limits.h"

namespace spincat::io {

struct FileContent {
  std::string_view bytes;        // all of them
  std::filesystem::path folder;  // in or below which files that belong to this one may lie
};

struct ObjectFormat {
  std::vector<std::string_view> extensions;  // in lower case, with their dot
  // Those that other files have, too: in a folder, a file called so is meant only where its first bytes are plainly of
  // this format.
  std::vector<std::string_view> ambiguous_extensions = {};
  Object (*read)(const FileContent& file, const ReadLimits& limits);
  // What the first bytes of a file say (see likeness.h), where they can say anything.
  Likeness (*likeness)(std::string_view first, std::uint64_t file_size) = nullptr;
};

// In the order of formats.inc.
const std::vector<ObjectFormat>& object_formats();

}  // namespace spincat::io
