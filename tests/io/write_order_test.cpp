// In which order a result reaches the disk, and what is left when a step of it fails. The calls of the system are taken
// over in this program: they are noted, or fail on demand, and are then passed on.
#include <dlfcn.h>
#include <gtest/gtest.h>
#include <stdio.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <iterator>
#include <string>
#include <vector>

#include "spincat/error.h"
#include "spincat/io/file.h"
#include "spincat/io/output_file.h"
#include "support/temp_dir.h"

namespace {

struct Watch {
  bool on = false;
  int fails_at = -1;  // number of the call that fails
  int error = EIO;
  std::vector<std::string> calls;
};

Watch& watch() {
  static Watch it;
  return it;
}

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

int fsync(int descriptor) {
  static const auto next = real<int(int)>("fsync");
  return noted(watch().on && is_folder(descriptor) ? "fsync folder" : "fsync") ? next(descriptor) : -1;
}

int rename(const char* from, const char* to) noexcept {
  static const auto next = real<int(const char*, const char*)>("rename");
  return noted("rename") ? next(from, to) : -1;
}

}  // extern "C"

namespace spincat {
namespace {

using Calls = std::vector<std::string>;

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
  std::string bytes(17'000'001, '\0');
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    bytes[i] = static_cast<char>(i * 7 + i / 4096);
  }
  const auto file = dir_.write("result", "old");
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
