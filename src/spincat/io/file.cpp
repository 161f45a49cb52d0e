#include "spincat/io/file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <filesystem>
#include <string>

#include "spincat/error.h"
#include "spincat/io/file_descriptor.h"
#include "spincat/io/system_words.h"

namespace spincat {

std::string read_file(const std::filesystem::path& file) {
  const FileDescriptor in(::open(file.c_str(), O_RDONLY | O_CLOEXEC));
  struct stat status = {};
  if (!in.valid() || ::fstat(in.number(), &status) != 0) throw InputError(file.string(), in_words(errno));
  if (S_ISDIR(status.st_mode)) throw InputError(file.string(), "is a folder, not a file");

  // One byte more than the size, so that the end of the file shows without growing; pipes have no size and do grow.
  constexpr std::size_t least = 4096;
  std::string bytes(std::max(static_cast<std::size_t>(status.st_size) + 1, least), '\0');
  std::size_t size = 0;
  while (true) {
    const ssize_t got = ::read(in.number(), bytes.data() + size, bytes.size() - size);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw InputError(file.string(), "cannot read: " + in_words(errno));
    if (got == 0) break;
    size += static_cast<std::size_t>(got);
    if (size == bytes.size()) bytes.resize(2 * bytes.size());
  }
  bytes.resize(size);
  return bytes;
}

}  // namespace spincat
