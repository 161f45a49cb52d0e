#include "spincat/files/temporary_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cctype>
#include <cerrno>
#include <mutex>
#include <set>
#include <string>
#include <system_error>

#include "spincat/files/file_descriptor.h"
#include "spincat/files/file_lock.h"

namespace spincat {
namespace {

namespace fs = std::filesystem;

// What the names of this host's temporary files begin with.
std::string prefix() {
  std::array<char, 65> host{};
  static_cast<void>(::gethostname(host.data(), host.size() - 1));
  std::string name = host.data();
  for (char& c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '.') {
      c = '_';
    }
  }
  return fmt::format(".spincat-{}-", name);
}

// Whether `name` is still the name of the open file.
bool is_named(int descriptor, const fs::path& name) {
  struct stat open = {};
  struct stat there = {};
  return ::fstat(descriptor, &open) == 0 && ::lstat(name.c_str(), &there) == 0 && S_ISREG(there.st_mode) &&
         open.st_dev == there.st_dev && open.st_ino == there.st_ino;
}

// With the lock in hand nobody else removes the file, and its writer is gone.
void remove_if_left(const fs::path& name) {
  const FileDescriptor file(::open(name.c_str(), O_WRONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  if (file.valid() && lock(file.number(), LOCK_EX | LOCK_NB) && is_named(file.number(), name)) {
    ::unlink(name.c_str());
  }
}

bool is_first_visit(const fs::path& folder) {
  static std::mutex mutex;
  static std::set<fs::path> visited;
  const std::lock_guard guard(mutex);
  return visited.insert(folder).second;
}

}  // namespace

int create_temporary(const fs::path& folder, fs::path& name) {
  static std::atomic<unsigned> counter{0};
  const std::string begin = prefix();
  for (int attempt = 0; attempt < 1000; ++attempt) {
    name = folder / fmt::format("{}{}-{}.tmp", begin, ::getpid(), counter++);
    const int descriptor = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor < 0) {
      if (errno != EEXIST) {
        return -1;
      }
      continue;
    }
    // A file system without locks says so here and to whoever cleans up, who then leaves the file alone.
    static_cast<void>(lock(descriptor, LOCK_EX));
    if (is_named(descriptor, name)) {
      return descriptor;
    }
    ::close(descriptor);  // taken for a leftover before it was locked
  }
  return -1;
}

void remove_leftovers(const fs::path& folder) {
  std::error_code error;
  if (!is_first_visit(fs::absolute(folder, error))) {
    return;
  }
  const std::string begin = prefix();
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (name.starts_with(begin) && name.ends_with(".tmp")) {
      remove_if_left(entry->path());
    }
  }
}

}  // namespace spincat
