#include "spincat/io/read_object.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
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
#include "spincat/files/paths.h"
#include "spincat/files/system_error_text.h"
#include "spincat/files/text_encoding.h"
#include "spincat/geometry/object.h"
#include "spincat/io/formats/format.h"
#include "spincat/io/formats/likeness.h"
#include "spincat/io/unread_format.h"

namespace spincat {
namespace {

bool is_one_of(std::string_view extension, const std::vector<std::string_view>& extensions) {
  return std::ranges::find(extensions, extension) != extensions.end();
}

// The format that a file is called by; nullptr where spincat reads none of that name.
const io::ObjectFormat* format_of(const std::filesystem::path& file) {
  const std::string extension = lower_extension(file);
  for (const io::ObjectFormat& format : io::object_formats()) {
    if (is_one_of(extension, format.extensions) || is_one_of(extension, format.ambiguous_extensions)) {
      return &format;
    }
  }
  return nullptr;
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
  if (const auto unread = unread_format(lower_extension(file))) {
    throw InputError(fmt::format("spincat does not read {} files; {}", unread->name, unread->advice));
  }
  const std::string extension = file.extension().string();
  throw InputError(fmt::format(
      "{}; spincat reads {}",
      extension.empty() ? "has no extension that tells its format" : fmt::format("unknown format '{}'", extension),
      fmt::join(object_extensions(), ", ")));
}

io::Likeness likeness(const io::ObjectFormat& format, std::string_view bytes) {
  return format.likeness == nullptr ? io::Likeness::none
                                    : format.likeness(bytes.substr(0, io::kLookedAt), bytes.size());
}

// The format that a file is called by, unless it begins plainly like one of another.
const io::ObjectFormat& format_of_content(std::string_view bytes, const io::ObjectFormat& called) {
  if (likeness(called, bytes) == io::Likeness::plain) {
    return called;
  }
  for (const io::ObjectFormat& format : io::object_formats()) {
    // Numbers alone may be an OFF file without its first line.
    const bool is_possible = format.likeness == io::likeness_of_xyz && called.likeness == io::likeness_of_off;
    if (!is_possible && likeness(format, bytes) == io::Likeness::plain) {
      return format;
    }
  }
  return called;
}

// "PLY" of ".ply".
std::string name_of(const io::ObjectFormat& format) {
  std::string name(format.extensions.front().substr(1));
  std::ranges::transform(name, name.begin(), [](char c) { return static_cast<char>(c - 'a' + 'A'); });
  return name;
}

Object read_content(const io::ObjectFormat& called, const io::FileContent& content, const ReadLimits& limits) {
  const io::ObjectFormat& format = format_of_content(content.bytes, called);
  try {
    return format.read(content, limits);
  } catch (const InputError& error) {
    if (&format == &called) {
      const std::string_view kind = called.likeness == nullptr ? "" : io::unread_kind(content.bytes);
      if (!kind.empty()) {
        throw InputError(fmt::format("is {}", kind));
      }
      throw;
    }
    throw InputError(error.file(), fmt::format("its content looks like {}: {}", name_of(format), error.problem()));
  }
}

Object read(const std::filesystem::path& file, const ReadLimits& limits) {
  std::error_code error;
  if (std::filesystem::is_directory(file, error)) {
    throw InputError("is a folder, not an object");
  }
  const io::ObjectFormat* format = format_of(file);
  if (format == nullptr) {
    fail_as_unknown(file);
  }
  std::string bytes = read_file(file);
  if (bytes.empty()) {
    throw InputError("is empty");
  }
  if (bytes.starts_with(kFileMagic)) {
    fail_as_model();
  }
  if (auto text = utf8_of_utf16(bytes)) {
    bytes = *std::move(text);
  }
  return read_content(*format, {bytes, file.parent_path()}, limits);
}

// Whether a regular file begins plainly like one of a format. One that cannot be read counts: whoever reads it says
// why.
bool begins_like(const io::ObjectFormat& format, const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) {
    return false;
  }
  try {
    std::string first = read_file(file, io::kLookedAt);
    const bool is_whole = first.size() < io::kLookedAt;
    if (auto text = utf8_of_utf16(first)) {
      first = *std::move(text);
    }
    return format.likeness != nullptr &&
           format.likeness(first, is_whole ? first.size() : first.size() + 1) == io::Likeness::plain;
  } catch (const InputError&) {
    return true;
  }
}

}  // namespace

Object read_object(const std::filesystem::path& file, const ReadLimits& limits) {
  try {
    return naming_file(file, [&] { return read(file, limits); });
  } catch (const std::bad_alloc&) {
    throw RunError(file.string(), "not enough memory to read it");
  } catch (const std::length_error&) {  // more than any memory has
    throw RunError(file.string(), "not enough memory to read it");
  }
}

Object read_listed_object(const std::filesystem::path& file, const ReadLimits& limits) {
  std::error_code error;
  if (!std::filesystem::is_directory(file, error)) {  // read_object says so
    expect_regular(file);
  }
  return read_object(file, limits);
}

bool has_object_name(const std::filesystem::path& file) {
  return format_of(file) != nullptr;
}

bool is_object_file(const std::filesystem::path& file) {
  const io::ObjectFormat* format = format_of(file);
  return format != nullptr && (is_one_of(lower_extension(file), format->extensions) || begins_like(*format, file));
}

const std::vector<std::string>& object_extensions() {
  static const std::vector<std::string> extensions = [] {
    std::vector<std::string> list;
    for (const io::ObjectFormat& format : io::object_formats()) {
      list.insert(list.end(), format.extensions.begin(), format.extensions.end());
    }
    return list;
  }();
  return extensions;
}

}  // namespace spincat
