// Hard files of 300 kB, 1 MB and 10 MB: none may take more memory than 20 times its size and 16 MB, and none more than
// time in proportion (a reader that does not would outlast the limit of the tests).
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "fuzz/counted_memory.h"
#include "fuzz/hard_files.h"
#include "fuzz/readers.h"

namespace spincat::test {
namespace {

class LargeFile : public testing::TestWithParam<Hard> {};

TEST_P(LargeFile, TakesMemoryInProportion) {
  const auto& [reader, name, make] = GetParam();
  for (const std::size_t size : {300'000, 1'000'000, 10'000'000}) {
    const std::string bytes = make(size);
    const CountedMemory memory;
    const std::vector<std::string> refusals = read_as(reader, bytes);
    const std::int64_t most = memory.most();
    EXPECT_LE(most, 20 * static_cast<std::int64_t>(bytes.size()) + 16'000'000);
    RecordProperty("memory_of_" + std::to_string(size), std::to_string(most));
    std::printf("%s, %s: %zu bytes, %.1f times in memory: %s\n", reader.c_str(), name.c_str(), bytes.size(),
                static_cast<double>(most) / static_cast<double>(bytes.size()),
                refusals.empty() ? "read" : refusals.front().substr(0, 160).c_str());
  }
}

INSTANTIATE_TEST_SUITE_P(Readers, LargeFile, testing::ValuesIn(hard_files()), [](const auto& hard) {
  std::string name = hard.param.reader + "_" + hard.param.name;
  std::ranges::replace(name, ' ', '_');
  return name;
});

}  // namespace
}  // namespace spincat::test
