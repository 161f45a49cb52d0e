// In which order a result reaches the disk, and what is left when a step of it fails.
#include <fcntl.h>
#include <gtest/gtest.h>

#include <cerrno>
#include <filesystem>
#include <iterator>
#include <string>
#include <vector>

#include "files/system_calls.h"
#include "spincat/error.h"
#include "spincat/files/file.h"
#include "spincat/files/file_descriptor.h"
#include "spincat/files/output_file.h"
#include "support/temp_dir.h"

namespace spincat {
namespace {

using Calls = std::vector<std::string>;
using test::watch;

const Calls kOrder = {"write", "fsync", "rename", "fsync folder"};

class WriteOrder : public testing::Test {
 protected:
  ~WriteOrder() override { watch() = {}; }

  // Writes the file, and gives the words of the error, if any.
  static std::string written(const std::filesystem::path& file, int fails_at, int error,
                             const std::string& bytes = "new") {
    watch() = {true, fails_at, error, {}};
    std::string problem;
    try {
      write_file_atomically(file, bytes);
    } catch (const RunError& failed) {
      problem = failed.what();
    }
    watch().on = false;
    return problem;
  }

  bool goes_past_the_cache() const {
    return FileDescriptor(::open(dir_.path().c_str(), O_TMPFILE | O_WRONLY | O_DIRECT, 0600)).valid();
  }

  std::ptrdiff_t files() const { return std::distance(std::filesystem::directory_iterator(dir_.path()), {}); }

  test::TempDir dir_;
};

TEST_F(WriteOrder, BytesThenNameThenFolder) {
  const auto file = dir_.write("result", "old");
  EXPECT_EQ(written(file, -1, 0), "");
  EXPECT_EQ(watch().calls, kOrder);
  EXPECT_EQ(read_file(file), "new");
}

TEST_F(WriteOrder, AFailedStepLeavesTheOldOrTheNewResultAndNothingElse) {
  for (int step = 0; step < static_cast<int>(kOrder.size()); ++step) {
    for (const int error : {EIO, ENOSPC, EDQUOT}) {
      const auto file = dir_.write("result", "old");
      EXPECT_NE(written(file, step, error).find("cannot write: "), std::string::npos) << kOrder[step];
      EXPECT_EQ(read_file(file), step < 3 ? "old" : "new") << kOrder[step];
      EXPECT_EQ(files(), 1) << kOrder[step];
    }
  }
}

TEST_F(WriteOrder, AnInterruptedWriteGoesOn) {
  const auto file = dir_.write("result", "old");
  EXPECT_EQ(written(file, 0, EINTR), "");
  EXPECT_EQ(watch().calls, (Calls{"write", "write", "fsync", "rename", "fsync folder"}));
  EXPECT_EQ(read_file(file), "new");
}

TEST_F(WriteOrder, AFileSystemThatCannotFlushIsNoError) {
  for (const int step : {1, 3}) {
    const auto file = dir_.write("result", "old");
    EXPECT_EQ(written(file, step, EINVAL), "") << kOrder[step];
    EXPECT_EQ(read_file(file), "new");
  }
}

// Four megabytes at a time past the cache, and what is left over as always; where one of them is refused, all that is
// left.
TEST_F(WriteOrder, ALargePieceArrivesWhateverTheDiskRefuses) {
  if (!goes_past_the_cache()) {
    GTEST_SKIP() << "the file system of the temporary files knows no O_DIRECT";
  }
  std::string bytes(17'000'001, '\0');
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    bytes[i] = static_cast<char>(i * 7 + i / 4096);
  }
  const auto file = dir_.write("result", "old");
  EXPECT_EQ(written(file, -1, 0, bytes), "");
  EXPECT_EQ(watch().calls, (Calls{"write", "write", "write", "write", "write", "fsync", "rename", "fsync folder"}));
  for (int refused = -1; refused < 4; ++refused) {
    for (const int error : {EINVAL, EINTR}) {
      EXPECT_EQ(written(file, refused, error, bytes), "");
      EXPECT_TRUE(read_file(file) == bytes) << refused;
    }
  }
}

TEST_F(WriteOrder, LargePiecesBeginAnywhere) {
  const std::string large(20'000'000, 'x');
  for (const std::size_t before : {1, 4095, 4096, 4097}) {
    OutputFile out(dir_ / "result");
    out.write(std::string(before, 'a'));
    out.write(large);
    out.write("b");
    out.write(large);
    out.commit();
    EXPECT_TRUE(read_file(dir_ / "result") == std::string(before, 'a') + large + "b" + large) << before;
  }
}

}  // namespace
}  // namespace spincat
