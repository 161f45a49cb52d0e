// Feeds any bytes to one of the readers, over and over (libFuzzer); SPINCAT_READER says to which. Found is whatever is
// no InputError of one line: a crash, another exception, more memory than 20 times the file and 16 MB, or more than a
// second of the processor. Prints at the end what the most memory and the longest call were.
#include <time.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "fuzz/counted_memory.h"
#include "fuzz/readers.h"

namespace {

constexpr std::int64_t kMostTimes = 20;
constexpr std::int64_t kSpare = 16 << 20;
constexpr double kMostMilliseconds = 1'000;

const char* reader = nullptr;

std::int64_t most_of_all = 0;
double longest = 0.0;  // of all calls

// Of the processor, as the machine may have other work.
double milliseconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

}  // namespace

// Ten times as fast as with the defaults.
extern "C" const char* __asan_default_options() {
  return "quarantine_size_mb=8:malloc_context_size=4";
}

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  reader = std::getenv("SPINCAT_READER");
  const auto& names = spincat::test::reader_names();
  if (reader == nullptr || std::ranges::find(names, reader) == names.end()) {
    std::fputs("SPINCAT_READER must name a reader:", stderr);
    for (const auto& name : names) {
      std::fprintf(stderr, " %s", name.c_str());
    }
    std::fputs("\n", stderr);
    std::exit(2);
  }
  std::atexit([] {
    std::fprintf(stderr, "most memory, in bytes: %lld\n", static_cast<long long>(most_of_all));
    std::fprintf(stderr, "longest, in milliseconds: %.3f\n", longest);
  });
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const spincat::test::CountedMemory memory;
  const double begin = milliseconds();
  spincat::test::read_as(reader, {reinterpret_cast<const char*>(data), size});
  const double taken = milliseconds() - begin;
  const std::int64_t most = memory.most();
  longest = std::max(longest, taken);
  most_of_all = std::max(most_of_all, most);
  if (most > kMostTimes * static_cast<std::int64_t>(size) + kSpare) {
    std::fprintf(stderr, "%lld bytes of memory for a file of %zu\n", static_cast<long long>(most), size);
    std::abort();
  }
  if (taken > kMostMilliseconds) {
    std::fprintf(stderr, "%.0f milliseconds for a file of %zu bytes\n", taken, size);
    std::abort();
  }
  return 0;
}
