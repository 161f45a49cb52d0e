#include "spincat/io/file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

#include "spincat/error.h"

namespace spincat {
namespace {

namespace fs = std::filesystem;

// What an errno value means, in the lower case of our one-line messages.
std::string in_words(int error) {
  if (error == ENOENT) return "no such file";
  std::string text = std::generic_category().message(error);
  // "Permission denied", but not "I/O error"
  if (text.size() > 1 && text[0] >= 'A' && text[0] <= 'Z' && text[1] >= 'a') text[0] = static_cast<char>(text[0] + 32);
  return text;
}

class FileDescriptor {
 public:
  explicit FileDescriptor(int number) : number_(number) {}
  ~FileDescriptor() {
    if (number_ >= 0) ::close(number_);
  }
  FileDescriptor(const FileDescriptor&) = delete;
  FileDescriptor& operator=(const FileDescriptor&) = delete;

  int number() const { return number_; }
  bool valid() const { return number_ >= 0; }
  // Network file systems tell only here that the disk is full.
  bool close() {
    const int number = number_;
    number_ = -1;
    return ::close(number) == 0;
  }

 private:
  int number_;
};

// Removes the temporary file unless it has become the real one.
class TemporaryName {
 public:
  explicit TemporaryName(fs::path path) : path_(std::move(path)) {}
  ~TemporaryName() {
    if (!kept_) ::unlink(path_.c_str());
  }
  TemporaryName(const TemporaryName&) = delete;
  TemporaryName& operator=(const TemporaryName&) = delete;

  const fs::path& path() const { return path_; }
  void keep() { kept_ = true; }

 private:
  fs::path path_;
  bool kept_ = false;
};

// What lies at a path, through symbolic links; nothing where there is nothing.
std::optional<struct stat> status_of(const fs::path& path) {
  struct stat status = {};
  if (::stat(path.c_str(), &status) != 0) return std::nullopt;
  return status;
}

void write_all(int descriptor, std::string_view bytes, const fs::path& file) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) throw RunError(file.string(), "cannot write: " + in_words(errno));
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

// Pipes and devices know no rename. Appending, because /dev/stdout may be a file that already holds other output.
void write_straight(const fs::path& file, std::string_view bytes) {
  FileDescriptor out(file == "/dev/stdout" ? ::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 0)
                                           : ::open(file.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC));
  if (!out.valid()) throw RunError(file.string(), "cannot write: " + in_words(errno));
  write_all(out.number(), bytes, file);
  if (!out.close()) throw RunError(file.string(), "cannot write: " + in_words(errno));
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

void replace_file(const fs::path& file, const fs::path& target, std::string_view bytes) {
  const auto fail = [&file] { throw RunError(file.string(), "cannot write: " + in_words(errno)); };
  fs::path name;
  FileDescriptor out(create_beside(target, name));
  if (!out.valid()) fail();
  TemporaryName temporary(name);
  if (const auto old = status_of(target); old && ::fchmod(out.number(), old->st_mode & 07777) != 0) fail();
  write_all(out.number(), bytes, file);
  if (!flush_to_disk(out.number()) || !out.close()) fail();
  if (::rename(temporary.path().c_str(), target.c_str()) != 0) fail();
  temporary.keep();
  // Without this a power cut may forget the rename.
  const FileDescriptor folder(::open(folder_of(target).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (folder.valid() && !flush_to_disk(folder.number())) fail();
}

}  // namespace

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

void write_file_atomically(const std::filesystem::path& file, std::string_view bytes) {
  if (is_written_straight(file)) return write_straight(file, bytes);
  const fs::path target = follow_links(file);
  check_replaceable(file, target);
  replace_file(file, target, bytes);
}

void check_writable(const std::filesystem::path& file) {
  if (is_written_straight(file)) {
    if (file != "/dev/stdout" && ::faccessat(AT_FDCWD, file.c_str(), W_OK, AT_EACCESS) != 0)
      throw RunError(file.string(), "cannot write: " + in_words(errno));
    return;
  }
  check_replaceable(file, follow_links(file));
}

}  // namespace spincat
