#include "spincat/io/output_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

#include "spincat/error.h"
#include "spincat/io/file.h"
#include "spincat/io/system_words.h"

namespace spincat {
namespace {

namespace fs = std::filesystem;

// What lies at a path, through symbolic links; nothing where there is nothing.
std::optional<struct stat> status_of(const fs::path& path) {
  struct stat status = {};
  if (::stat(path.c_str(), &status) != 0) return std::nullopt;
  return status;
}

bool is_written_straight(const fs::path& file) {
  if (file == "/dev/stdout" || file == "/dev/stderr") return true;
  const auto status = status_of(file);
  return status && !S_ISREG(status->st_mode) && !S_ISDIR(status->st_mode);
}

// The name that a chain of symbolic links ends in, whether a file is there or not.
fs::path follow_links(const fs::path& file) {
  constexpr int most_links = 40;  // as many as the kernel follows
  fs::path target = file;
  std::error_code error;
  for (int i = 0; i < most_links && fs::is_symlink(fs::symlink_status(target, error)); ++i)
    target = target.parent_path() / fs::read_symlink(target, error);
  return target;
}

fs::path folder_of(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

// Throws when `target`, which `file` leads to, could not be replaced.
void check_replaceable(const fs::path& file, const fs::path& target) {
  const fs::path folder = folder_of(target);
  const auto folder_status = status_of(folder);
  if (!folder_status || !S_ISDIR(folder_status->st_mode))
    throw InputError(file.string(), fmt::format("there is no folder '{}' to write it to", folder.string()));
  const auto status = status_of(target);
  if ((status && S_ISDIR(status->st_mode)) || !target.has_filename())
    throw InputError(file.string(), "is a folder, so no file can be written under that name");
  // A rename would replace a write-protected file: its owner did not mean that.
  if ((status && ::faccessat(AT_FDCWD, target.c_str(), W_OK, AT_EACCESS) != 0) ||
      ::faccessat(AT_FDCWD, folder.c_str(), W_OK | X_OK, AT_EACCESS) != 0)
    throw RunError(file.string(), "cannot write: " + in_words(errno));
}

// Creates a file that nobody else has, with the mode that the process gives its files; -1 on failure.
int create_beside(const fs::path& target, fs::path& name) {
  static std::atomic<unsigned> counter{0};
  for (int attempt = 0; attempt < 1000; ++attempt) {
    name = folder_of(target) / fmt::format(".spincat-{}-{}.tmp", ::getpid(), counter++);
    const int descriptor = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor >= 0 || errno != EEXIST) return descriptor;
  }
  return -1;
}

// Some file systems cannot flush and say so; that is no reason to fail.
bool flush_to_disk(int descriptor) {
  return ::fsync(descriptor) == 0 || errno == EINVAL || errno == ENOTSUP || errno == EROFS;
}

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
    descriptor_ = create_beside(target_, temporary_);
  }
  if (descriptor_ < 0) fail();
}

OutputFile::~OutputFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void OutputFile::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail();
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

void OutputFile::commit() {
  const bool renames = !temporary_.empty();
  if (renames) {
    if (const auto old = status_of(target_); old && ::fchmod(descriptor_, old->st_mode & 07777) != 0) fail();
    if (!flush_to_disk(descriptor_)) fail();
  }
  // Network file systems tell only on closing that the disk is full.
  const int descriptor = descriptor_;
  descriptor_ = -1;
  if (::close(descriptor) != 0) fail();
  if (!renames) return;
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) fail();
  temporary_.clear();
  // Without this a power cut may forget the rename.
  const int folder = ::open(folder_of(target_).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder >= 0) {
    const bool flushed = flush_to_disk(folder);
    ::close(folder);
    if (!flushed) fail();
  }
}

void OutputFile::fail() const {
  throw RunError(file_.string(), "cannot write: " + in_words(errno));
}

void write_file_atomically(const fs::path& file, std::string_view bytes) {
  OutputFile out(file);
  out.write(bytes);
  out.commit();
}

void check_writable(const fs::path& file) {
  if (is_written_straight(file)) {
    if (file != "/dev/stdout" && ::faccessat(AT_FDCWD, file.c_str(), W_OK, AT_EACCESS) != 0)
      throw RunError(file.string(), "cannot write: " + in_words(errno));
    return;
  }
  check_replaceable(file, follow_links(file));
}

}  // namespace spincat
