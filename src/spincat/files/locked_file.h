// A file that one run at a time reads and writes in place: what journals are kept in.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "spincat/error.h"

namespace spincat {

// Another run holds the lock.
class InUseError : public RunError {
 public:
  using RunError::RunError;
};

class LockedFile {
 public:
  // Opens `name`, or begins an empty file, and holds a lock on it (flock) until the end. Throws RunError when it cannot
  // be opened for writing, InUseError when another run holds the lock. A file system without locks lets everybody in.
  explicit LockedFile(std::filesystem::path name);
  ~LockedFile();
  LockedFile(const LockedFile&) = delete;
  LockedFile& operator=(const LockedFile&) = delete;

  const std::filesystem::path& name() const { return name_; }

  // These throw RunError when the system refuses.
  std::uint64_t size() const;
  std::optional<std::string> read(std::uint64_t offset, std::uint64_t length) const;  // nothing where there are fewer
  void write(std::uint64_t offset, std::string_view bytes);
  void cut(std::uint64_t size);
  void flush();  // waits until all is on the disk, its name too

  // Removes the name; the lock stays until the end.
  void remove();

 private:
  [[noreturn]] void fail(const char* what) const;

  std::filesystem::path name_;
  int descriptor_;
  bool name_is_on_disk_ = false;
};

}  // namespace spincat
