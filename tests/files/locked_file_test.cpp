#include "spincat/files/locked_file.h"

#include <gtest/gtest.h>

#include "files/system_calls.h"
#include "spincat/error.h"
#include "spincat/files/file.h"
#include "support/expect_error.h"
#include "support/temp_dir.h"

namespace spincat {
namespace {

using Calls = std::vector<std::string>;
using test::watch;

class LockedFileTest : public testing::Test {
 protected:
  ~LockedFileTest() override { watch() = {}; }

  test::TempDir dir_;
  const std::filesystem::path name_ = dir_ / "journal";
};

TEST_F(LockedFileTest, KeepsWhatIsWrittenAnywhereInIt) {
  {
    LockedFile file(name_);
    EXPECT_EQ(file.size(), 0U);
    file.write(0, "abcdef");
    file.write(2, "--");
    file.cut(5);
    EXPECT_EQ(file.read(1, 3), "b--");
    EXPECT_EQ(file.read(3, 3), std::nullopt);
  }
  EXPECT_EQ(read_file(name_), "ab--e");
}

TEST_F(LockedFileTest, IsForOneAtATime) {
  const LockedFile file(name_);
  test::expect_error<RunError>([&] { LockedFile(dir_ / "journal"); }, name_.string() + ": is in use by another run");
}

TEST_F(LockedFileTest, IsNotOfFewerBytesWhereTheDiskCannotBeRead) {
  LockedFile file(name_);
  file.write(0, "abcdef");
  watch() = {true, 0, EIO, {}};
  test::expect_error<RunError>([&] { file.read(0, 6); }, name_.string() + ": cannot read: input/output error");
  watch() = {true, 0, EINTR, {}};
  EXPECT_EQ(file.read(0, 6), "abcdef");
}

TEST_F(LockedFileTest, FlushesItsNameOnce) {
  LockedFile file(name_);
  watch() = {true, 0, EINTR, {}};
  file.flush();
  file.flush();
  EXPECT_EQ(watch().calls, (Calls{"fsync", "fsync", "fsync folder", "fsync"}));
}

}  // namespace
}  // namespace spincat
