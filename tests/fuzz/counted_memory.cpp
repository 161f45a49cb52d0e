#include "fuzz/counted_memory.h"

#include <malloc.h>

#include <atomic>
#include <cerrno>
#include <cstdlib>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define SPINCAT_SANITIZED
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define SPINCAT_SANITIZED
#endif
#endif

#ifdef SPINCAT_SANITIZED
#include <sanitizer/allocator_interface.h>
#endif

namespace {

std::atomic<std::int64_t> in_use = 0;
std::atomic<std::int64_t> most = 0;

void count(std::int64_t size) {
  const std::int64_t now = in_use += size;
  if (now > most) {
    most = now;
  }
}

}  // namespace

#ifdef SPINCAT_SANITIZED

namespace {

std::int64_t size_of(const volatile void* memory) {
  return static_cast<std::int64_t>(__sanitizer_get_allocated_size(const_cast<const void*>(memory)));
}

[[maybe_unused]] const int installed = __sanitizer_install_malloc_and_free_hooks(
    [](const volatile void* memory, std::size_t) { count(size_of(memory)); },
    [](const volatile void* memory) { in_use -= memory != nullptr ? size_of(memory) : 0; });

}  // namespace

#else

// In place of the C library's, under whose other names they still are there: so that what libraries take is counted,
// too.
extern "C" {

void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t number, std::size_t size);
void* __libc_realloc(void* memory, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
void __libc_free(void* memory);

static void* counted(void* memory) {
  count(static_cast<std::int64_t>(malloc_usable_size(memory)));
  return memory;
}

void* malloc(std::size_t size) {
  return counted(__libc_malloc(size));
}

void* calloc(std::size_t number, std::size_t size) {
  return counted(__libc_calloc(number, size));
}

void* realloc(void* memory, std::size_t size) {
  const auto before = static_cast<std::int64_t>(malloc_usable_size(memory));
  void* const grown = __libc_realloc(memory, size);
  if (grown != nullptr || size == 0) {
    in_use -= before;
    counted(grown);
  }
  return grown;
}

void* memalign(std::size_t alignment, std::size_t size) {
  return counted(__libc_memalign(alignment, size));
}

void* aligned_alloc(std::size_t alignment, std::size_t size) {
  return memalign(alignment, size);
}

int posix_memalign(void** memory, std::size_t alignment, std::size_t size) {
  *memory = memalign(alignment, size);
  return *memory != nullptr ? 0 : ENOMEM;
}

void free(void* memory) {
  in_use -= static_cast<std::int64_t>(malloc_usable_size(memory));
  __libc_free(memory);
}

}  // extern "C"

#endif

namespace spincat::test {

CountedMemory::CountedMemory() : before_(in_use) {
  ::most = before_;
}

std::int64_t CountedMemory::most() const {
  return ::most - before_;
}

}  // namespace spincat::test
