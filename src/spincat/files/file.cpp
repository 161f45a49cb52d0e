#include "spincat/files/file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <filesystem>
#include <string>

#include "spincat/error.h"
#include "spincat/files/file_descriptor.h"
#include "spincat/files/system_error_text.h"

namespace spincat {
namespace {

bool is_device(const struct stat& status) {
  return S_ISCHR(status.st_mode) || S_ISBLK(status.st_mode);
}

bool is_same_device(const struct stat& a, const struct stat& b) {
  return (a.st_mode & S_IFMT) == (b.st_mode & S_IFMT) && a.st_rdev == b.st_rdev;
}

// /dev/zero and the like would fill the memory. A terminal ends when its user says so, where he reads from it.
bool may_be_endless(const struct stat& status) {
  if (!is_device(status)) {
    return false;
  }
  struct stat other = {};
  if (::stat("/dev/null", &other) == 0 && is_same_device(status, other)) {
    return false;
  }
  return ::fstat(STDIN_FILENO, &other) != 0 || !is_same_device(status, other);
}

}  // namespace

std::string read_file(const std::filesystem::path& file, std::size_t most) {
  struct stat status = {};
  // Before it is opened, which may be to wait for a device.
  if (::stat(file.c_str(), &status) != 0) {
    throw InputError(file.string(), system_error_text(errno));
  }
  if (S_ISDIR(status.st_mode)) {
    throw InputError(file.string(), "is a folder, not a file");
  }
  if (may_be_endless(status)) {
    throw InputError(file.string(), "is a device, not a file");
  }
  const FileDescriptor in(::open(file.c_str(), O_RDONLY | O_CLOEXEC));
  if (!in.valid() || ::fstat(in.number(), &status) != 0) {
    throw InputError(file.string(), system_error_text(errno));
  }

  // One byte more than the size, so that the end of the file shows without growing; pipes have no size and do grow.
  constexpr std::size_t kLeast = 4096;
  std::string bytes(std::min(most, std::max(static_cast<std::size_t>(status.st_size) + 1, kLeast)), '\0');
  std::size_t size = 0;
  while (size < most) {
    const ssize_t got = ::read(in.number(), bytes.data() + size, bytes.size() - size);
    if (got < 0 && errno == EINTR) {
      continue;
    }
    if (got < 0) {
      throw InputError(file.string(), "cannot read: " + system_error_text(errno));
    }
    if (got == 0) {
      break;
    }
    size += static_cast<std::size_t>(got);
    if (size == bytes.size()) {
      bytes.resize(std::min(most, 2 * bytes.size()));
    }
  }
  bytes.resize(size);
  return bytes;
}

}  // namespace spincat
