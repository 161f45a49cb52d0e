// Waiting for the disk.
#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>

#include "spincat/files/file_descriptor.h"

namespace spincat {

// Waits until what was written is on the disk. True where the file system cannot flush and says so; else false and
// errno.
inline bool flush_to_disk(int descriptor) {
  int result = 0;
  do {
    result = ::fsync(descriptor);
  } while (result != 0 && errno == EINTR);
  return result == 0 || errno == EINVAL || errno == ENOTSUP || errno == EROFS;
}

// The same for the names of a folder: without it a power cut may forget a new one. True where the folder cannot be
// read.
inline bool flush_names(const std::filesystem::path& folder) {
  const FileDescriptor descriptor(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  return !descriptor.valid() || flush_to_disk(descriptor.number());
}

}  // namespace spincat
