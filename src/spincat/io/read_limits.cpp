#include "spincat/io/read_limits.h"

#include <fmt/format.h>

#include <algorithm>

#include "spincat/error.h"

namespace spincat {

void check_growth(std::uint64_t memory, std::uint64_t file_size, const ReadLimits& limits) {
  constexpr std::uint64_t kFree = 16'000'000;
  if (memory > kFree && (memory - kFree) / std::max<std::size_t>(limits.max_growth, 1) > file_size) {
    throw InputError(
        fmt::format("would take {} bytes of memory, more than {} times its {} bytes and 16 MB; --max-growth raises "
                    "this limit",
                    memory, limits.max_growth, file_size));
  }
}

}  // namespace spincat
