#include "spincat/files/paths.h"

#include <system_error>

#include "spincat/files/system_error_text.h"

namespace spincat {

namespace fs = std::filesystem;

std::string lower_extension(const fs::path& file) {
  std::string extension = file.extension().string();
  for (char& c : extension) {
    if (c >= 'A' && c <= 'Z') {
      c = static_cast<char>(c - 'A' + 'a');
    }
  }
  return extension;
}

fs::file_status status_of(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::status_known(status)) {
    throw InputError(path.string(), system_error_text(error.value()));
  }
  return status;
}

bool is_regular_or_missing(const fs::file_status& status) {
  return fs::is_regular_file(status) || !fs::exists(status);
}

void expect_regular(const fs::path& file) {
  const fs::file_status status = status_of(file);
  if (!is_regular_or_missing(status)) {
    throw InputError(file.string(), fs::is_directory(status) ? "is a folder, not a file" : "is not a regular file");
  }
}

}  // namespace spincat
