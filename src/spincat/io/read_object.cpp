#include "spincat/io/read_object.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <new>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "spincat/error.h"
#include "spincat/files/file.h"
#include "spincat/files/magic.h"
#include "spincat/files/system_error_text.h"
#include "spincat/geometry/object.h"
#include "spincat/io/formats/formats.h"

namespace spincat {
namespace {

struct Format {
  std::string_view extension;
  Object (*read)(std::string_view bytes, const std::filesystem::path& folder, const ReadLimits& limits);
};

template <Object (*reader)(std::string_view, const ReadLimits&)>
Object without_folder(std::string_view bytes, const std::filesystem::path&, const ReadLimits& limits) {
  return reader(bytes, limits);
}

constexpr std::array formats{
    Format{".off", without_folder<io::read_off>},
    Format{".obj", without_folder<io::read_obj>},
    Format{".ply", without_folder<io::read_ply>},
    Format{".stl", without_folder<io::read_stl>},
    Format{".pcd", without_folder<io::read_pcd>},
    Format{".xyz", without_folder<io::read_xyz>},
    Format{".xyzn", without_folder<io::read_xyz>},
    Format{".pts", without_folder<io::read_xyz>},
    Format{".asc", without_folder<io::read_xyz>},
    Format{".gltf", io::read_gltf},
    Format{".glb", io::read_gltf},
    Format{".txt", without_folder<io::read_xyz>},
};

std::string lower_extension(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  for (char& c : extension) {
    if (c >= 'A' && c <= 'Z') {
      c = static_cast<char>(c - 'A' + 'a');
    }
  }
  return extension;
}

const Format* format_of(const std::filesystem::path& file) {
  const std::string extension = lower_extension(file);
  const auto* found =
      std::find_if(formats.begin(), formats.end(), [&](const Format& f) { return f.extension == extension; });
  return found == formats.end() ? nullptr : found;
}

[[noreturn]] void fail_as_model() {
  throw InputError("is a spincat model, not an object");
}

[[noreturn]] void fail_as_unknown(const std::filesystem::path& file) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) {
    throw InputError(system_error_text(error.value()));
  }
  // The first bytes only: a file of an unknown kind may be of any size.
  if (std::filesystem::is_regular_file(status) && read_file(file, kFileMagic.size()) == kFileMagic) {
    fail_as_model();
  }
  const std::string extension = file.extension().string();
  throw InputError(fmt::format(
      "{}; spincat reads {}",
      extension.empty() ? "has no extension that tells its format" : fmt::format("unknown format '{}'", extension),
      fmt::join(object_extensions(), ", ")));
}

Object read(const std::filesystem::path& file, const ReadLimits& limits) {
  std::error_code error;
  if (std::filesystem::is_directory(file, error)) {
    throw InputError("is a folder, not an object");
  }
  const Format* format = format_of(file);
  if (format == nullptr) {
    fail_as_unknown(file);
  }
  const std::string bytes = read_file(file);
  if (bytes.empty()) {
    throw InputError("is empty");
  }
  if (bytes.starts_with(kFileMagic)) {
    fail_as_model();
  }
  return format->read(bytes, file.parent_path(), limits);
}

}  // namespace

Object read_object(const std::filesystem::path& file, const ReadLimits& limits) {
  try {
    return read(file, limits);
  } catch (const InputError& error) {
    if (!error.file().empty()) {
      throw;
    }
    throw InputError(file.string(), error.problem());
  } catch (const std::bad_alloc&) {
    throw RunError(file.string(), "not enough memory to read it");
  } catch (const std::length_error&) {  // more than any memory has
    throw RunError(file.string(), "not enough memory to read it");
  }
}

Object read_listed_object(const std::filesystem::path& file, const ReadLimits& limits) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(file, error);
  const bool is_other = std::filesystem::exists(status) && !std::filesystem::is_directory(status) &&
                        !std::filesystem::is_regular_file(status);
  if (is_other) {
    throw InputError(file.string(), "is not a regular file");
  }
  return read_object(file, limits);
}

bool is_object_file(const std::filesystem::path& file) {
  const Format* format = format_of(file);
  return format != nullptr && format->extension != ".txt";
}

const std::vector<std::string>& object_extensions() {
  static const std::vector<std::string> extensions = [] {
    std::vector<std::string> list;
    for (const Format& format : formats) {
      if (format.extension != ".txt") {
        list.emplace_back(format.extension);
      }
    }
    return list;
  }();
  return extensions;
}

}  // namespace spincat
