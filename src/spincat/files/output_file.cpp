#include "spincat/files/output_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "spincat/error.h"
#include "spincat/files/file.h"
#include "spincat/files/file_descriptor.h"
#include "spincat/files/flush_to_disk.h"
#include "spincat/files/system_error_text.h"
#include "spincat/files/temporary_file.h"

namespace spincat {
namespace {

namespace fs = std::filesystem;

// What lies at a path, through symbolic links; nothing where there is nothing.
std::optional<struct stat> status_of(const fs::path& path) {
  struct stat status = {};
  if (::stat(path.c_str(), &status) != 0) {
    return std::nullopt;
  }
  return status;
}

bool is_written_straight(const fs::path& file) {
  if (file == "/dev/stdout" || file == "/dev/stderr") {
    return true;
  }
  const auto status = status_of(file);
  return status && !S_ISREG(status->st_mode) && !S_ISDIR(status->st_mode);
}

// The name that a chain of symbolic links ends in, whether a file is there or not.
fs::path follow_links(const fs::path& file) {
  constexpr int kMostLinks = 40;  // as many as the kernel follows
  fs::path target = file;
  std::error_code error;
  for (int i = 0; i < kMostLinks && fs::is_symlink(fs::symlink_status(target, error)); ++i) {
    target = target.parent_path() / fs::read_symlink(target, error);
  }
  return target;
}

fs::path folder_of(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

// Throws when `target`, which `file` leads to, could not be replaced.
void check_replaceable(const fs::path& file, const fs::path& target) {
  const fs::path folder = folder_of(target);
  const auto folder_status = status_of(folder);
  if (!folder_status || !S_ISDIR(folder_status->st_mode)) {
    throw InputError(file.string(), fmt::format("there is no folder '{}' to write it to", folder.string()));
  }
  const auto status = status_of(target);
  if ((status && S_ISDIR(status->st_mode)) || !target.has_filename()) {
    throw InputError(file.string(), "is a folder, so no file can be written under that name");
  }
  // A rename would replace a write-protected file: its owner did not mean that.
  if ((status && ::faccessat(AT_FDCWD, target.c_str(), W_OK, AT_EACCESS) != 0) ||
      ::faccessat(AT_FDCWD, folder.c_str(), W_OK | X_OK, AT_EACCESS) != 0) {
    throw RunError(file.string(), "cannot write: " + system_error_text(errno));
  }
}

constexpr std::size_t kLarge = std::size_t{16} << 20;  // from so many bytes on, past the cache
constexpr std::size_t kPiece = std::size_t{4} << 20;
constexpr std::size_t kSector = 4096;  // a multiple of every disk's

// Pipes and devices know no rename. Appending, because /dev/stdout may be a file that already holds other output.
int open_straight(const fs::path& file) {
  return file == "/dev/stdout" ? ::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 0)
                               : ::open(file.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
}

}  // namespace

OutputFile::OutputFile(const fs::path& file) : file_(file) {
  if (is_written_straight(file)) {
    descriptor_ = open_straight(file);
  } else {
    target_ = follow_links(file);
    check_replaceable(file, target_);
    remove_leftovers(folder_of(target_));
    fs::path name;
    descriptor_ = create_temporary(folder_of(target_), name);
    if (descriptor_ >= 0) {
      temporary_ = name;
    }
  }
  if (descriptor_ < 0) {
    fail();
  }
}

OutputFile::~OutputFile() {
  if (descriptor_ >= 0) {
    ::close(descriptor_);
  }
  if (!temporary_.empty()) {
    ::unlink(temporary_.c_str());
  }
}

void OutputFile::write(std::string_view bytes) {
  if (bytes.size() >= kLarge && !temporary_.empty()) {
    bytes.remove_prefix(write_past_cache(bytes));
  }
  write_all(bytes);
}

void OutputFile::write_all(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) {
      continue;
    }
    if (written < 0) {
      fail();
    }
    bytes.remove_prefix(static_cast<std::size_t>(written));
    written_ += static_cast<std::uint64_t>(written);
  }
}

// Results are flushed to the disk anyway, and taking memory for the cache may take longer than the disk itself
// (docs/results/speed.md). Returns how many bytes it has written: those before the first place that the disk can begin
// at, which go the usual way, and whole pieces. What is left is the caller's; all of it where the file system cannot.
std::size_t OutputFile::write_past_cache(std::string_view bytes) {
  const std::size_t before = (kSector - written_ % kSector) % kSector;
  write_all(bytes.substr(0, before));
  std::size_t done = before;
  const int flags = ::fcntl(descriptor_, F_GETFL);
  const std::unique_ptr<char, decltype(&std::free)> piece(static_cast<char*>(std::aligned_alloc(kSector, kPiece)),
                                                          &std::free);
  if (!piece || flags < 0 || ::fcntl(descriptor_, F_SETFL, flags | O_DIRECT) != 0) {
    return done;
  }
  while (bytes.size() - done >= kPiece) {
    std::memcpy(piece.get(), bytes.data() + done, kPiece);
    const ssize_t written = ::write(descriptor_, piece.get(), kPiece);
    if (written != static_cast<ssize_t>(kPiece)) {  // the usual way goes on, and knows the reason
      done += static_cast<std::size_t>(std::max<ssize_t>(written, 0));
      break;
    }
    done += kPiece;
  }
  written_ += done - before;
  if (::fcntl(descriptor_, F_SETFL, flags) != 0) {
    fail();
  }
  return done;
}

// The order of a power cut: the bytes are on the disk before the name is theirs, and the name before we say so.
void OutputFile::commit() {
  const bool renames = !temporary_.empty();
  if (renames) {
    if (const auto old = status_of(target_); old && ::fchmod(descriptor_, old->st_mode & 07777) != 0) {
      fail();
    }
    if (!flush_to_disk(descriptor_)) {
      fail();
    }
  }
  // The duplicate keeps the lock until the file has its name; without it, it could be taken for a leftover.
  const FileDescriptor lock(renames ? ::fcntl(descriptor_, F_DUPFD_CLOEXEC, 0) : -1);
  // Network file systems tell only on closing that the disk is full.
  if (::close(std::exchange(descriptor_, -1)) != 0) {
    fail();
  }
  if (!renames) {
    return;
  }
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) {
    fail();
  }
  temporary_.clear();
  if (!flush_names(folder_of(target_))) {
    fail();
  }
}

void OutputFile::fail() const {
  throw RunError(file_.string(), "cannot write: " + system_error_text(errno));
}

void write_file_atomically(const fs::path& file, std::string_view bytes) {
  OutputFile out(file);
  out.write(bytes);
  out.commit();
}

void check_writable(const fs::path& file) {
  if (is_written_straight(file)) {
    if (file != "/dev/stdout" && ::faccessat(AT_FDCWD, file.c_str(), W_OK, AT_EACCESS) != 0) {
      throw RunError(file.string(), "cannot write: " + system_error_text(errno));
    }
    return;
  }
  check_replaceable(file, follow_links(file));
}

}  // namespace spincat
