// What the names of files tell, and what they lead to.
#pragma once

#include <filesystem>
#include <string>
#include <utility>

#include "spincat/error.h"

namespace spincat {

// ".obj" of "Chair.OBJ"; empty where there is none. ASCII only, whatever the locale.
std::string lower_extension(const std::filesystem::path& file);

// What a path leads to; nothing there is an answer, too. Throws InputError where that cannot be known.
std::filesystem::file_status status_of(const std::filesystem::path& path);

// The rule for files that nobody chose by hand but that a folder holds or a list names: such a file may be a device
// that never ends, or a pipe that nobody writes to. True for a regular file, for a link to one and where nothing is
// there (whoever reads it says so).
bool is_regular_or_missing(const std::filesystem::file_status& status);

// Throws InputError where that rule does not hold.
void expect_regular(const std::filesystem::path& file);

// What `work` returns. An InputError of it that knows no file gets the name of this one.
template <typename Work>
auto naming_file(const std::filesystem::path& file, Work&& work) {
  try {
    return std::forward<Work>(work)();
  } catch (const InputError& error) {
    if (!error.file().empty()) {
      throw;
    }
    throw InputError(file.string(), error.problem());
  }
}

}  // namespace spincat
