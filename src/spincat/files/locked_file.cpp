#include "spincat/files/locked_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <utility>

#include "spincat/error.h"
#include "spincat/files/file_lock.h"
#include "spincat/files/flush_to_disk.h"
#include "spincat/files/system_error_text.h"

namespace spincat {
namespace {

// The descriptor, or -1 and errno: EWOULDBLOCK where another run holds the lock.
int open_locked(const std::filesystem::path& name) {
  struct stat status = {};
  while (true) {
    const int descriptor = ::open(name.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
    if (descriptor < 0) {
      return -1;
    }
    const bool is_held = !lock(descriptor, LOCK_EX | LOCK_NB) && errno == EWOULDBLOCK;
    // Another run may have finished and removed the file since it was opened.
    const bool is_removed = ::fstat(descriptor, &status) == 0 && status.st_nlink == 0;
    if (!is_held && !is_removed) {
      return descriptor;
    }
    ::close(descriptor);
    if (is_held) {
      errno = EWOULDBLOCK;
      return -1;
    }
  }
}

}  // namespace

LockedFile::LockedFile(std::filesystem::path name) : name_(std::move(name)), descriptor_(open_locked(name_)) {
  if (descriptor_ < 0 && errno == EWOULDBLOCK) {
    throw InUseError(name_.string(), "is in use by another run");
  }
  if (descriptor_ < 0) {
    fail("cannot write");
  }
}

LockedFile::~LockedFile() {
  ::close(descriptor_);
}

std::uint64_t LockedFile::size() const {
  struct stat status = {};
  if (::fstat(descriptor_, &status) != 0) {
    fail("cannot read");
  }
  return static_cast<std::uint64_t>(status.st_size);
}

std::optional<std::string> LockedFile::read(std::uint64_t offset, std::uint64_t length) const {
  std::string bytes(length, '\0');
  std::size_t got = 0;
  while (got < length) {
    const ssize_t read = ::pread(descriptor_, bytes.data() + got, length - got, static_cast<off_t>(offset + got));
    if (read < 0 && errno == EINTR) {
      continue;
    }
    if (read < 0) {
      fail("cannot read");
    }
    if (read == 0) {
      return std::nullopt;
    }
    got += static_cast<std::size_t>(read);
  }
  return bytes;
}

void LockedFile::write(std::uint64_t offset, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (written < 0 && errno == EINTR) {
      continue;
    }
    if (written < 0) {
      fail("cannot write");
    }
    bytes.remove_prefix(static_cast<std::size_t>(written));
    offset += static_cast<std::uint64_t>(written);
  }
}

void LockedFile::cut(std::uint64_t size) {
  if (::ftruncate(descriptor_, static_cast<off_t>(size)) != 0) {
    fail("cannot write");
  }
}

void LockedFile::flush() {
  if (!flush_to_disk(descriptor_)) {
    fail("cannot write");
  }
  if (!name_is_on_disk_ && !flush_names(name_.has_parent_path() ? name_.parent_path() : ".")) {
    fail("cannot write");
  }
  name_is_on_disk_ = true;
}

void LockedFile::remove() {
  ::unlink(name_.c_str());
}

void LockedFile::fail(const char* what) const {
  throw RunError(name_.string(), std::string(what) + ": " + system_error_text(errno));
}

}  // namespace spincat
