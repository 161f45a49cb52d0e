#include "files/system_calls.h"

#include <dlfcn.h>
#include <stdio.h>
#include <sys/stat.h>
#include <unistd.h>

namespace spincat::test {

Watch& watch() {
  static Watch it;
  return it;
}

}  // namespace spincat::test

namespace {

using spincat::test::Watch;
using spincat::test::watch;

// Whether this call is to be done; otherwise errno says why it failed.
bool noted(const std::string& call) {
  Watch& it = watch();
  if (!it.on) {
    return true;
  }
  it.calls.push_back(call);
  if (static_cast<int>(it.calls.size()) - 1 == it.fails_at) {
    errno = it.error;
    return false;
  }
  return true;
}

bool is_folder(int descriptor) {
  struct stat status = {};
  return fstat(descriptor, &status) == 0 && S_ISDIR(status.st_mode);
}

template <typename Function>
Function* real(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" {

ssize_t write(int descriptor, const void* bytes, size_t size) {
  static const auto next = real<ssize_t(int, const void*, size_t)>("write");
  return noted("write") ? next(descriptor, bytes, size) : -1;
}

ssize_t pread(int descriptor, void* bytes, size_t size, off_t offset) {
  static const auto next = real<ssize_t(int, void*, size_t, off_t)>("pread");
  return noted("pread") ? next(descriptor, bytes, size, offset) : -1;
}

int fsync(int descriptor) {
  static const auto next = real<int(int)>("fsync");
  return noted(watch().on && is_folder(descriptor) ? "fsync folder" : "fsync") ? next(descriptor) : -1;
}

int rename(const char* from, const char* to) noexcept {
  static const auto next = real<int(const char*, const char*)>("rename");
  return noted("rename") ? next(from, to) : -1;
}

}  // extern "C"
