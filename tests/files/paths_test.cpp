#include "spincat/files/paths.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <stdexcept>
#include <string>

#include "support/expect_error.h"
#include "support/temp_dir.h"

namespace spincat {
namespace {

namespace fs = std::filesystem;

TEST(LowerExtension, IsTheLastOne) {
  EXPECT_EQ(lower_extension("folder.d/Chair.OBJ"), ".obj");
  EXPECT_EQ(lower_extension("a.tar.Gz"), ".gz");
  EXPECT_EQ(lower_extension("a"), "");
  EXPECT_EQ(lower_extension(".off"), "");
}

TEST(ExpectRegular, RefusesWhatIsThereAndNoFile) {
  const test::TempDir dir;
  dir.write("file", "x");
  fs::create_symlink("file", dir / "link");
  fs::create_symlink("/dev/zero", dir / "endless");
  ASSERT_EQ(::mkfifo((dir / "pipe").c_str(), 0600), 0);
  EXPECT_NO_THROW(expect_regular(dir / "file"));
  EXPECT_NO_THROW(expect_regular(dir / "link"));
  EXPECT_NO_THROW(expect_regular(dir / "missing"));
  EXPECT_EQ(test::input_error([&] { expect_regular(dir / "endless"); }),
            (dir / "endless").string() + ": is not a regular file");
  EXPECT_EQ(test::input_error([&] { expect_regular(dir / "pipe"); }),
            (dir / "pipe").string() + ": is not a regular file");
  EXPECT_EQ(test::input_error([&] { expect_regular(dir.path()); }), dir.path().string() + ": is a folder, not a file");
}

TEST(NamingFile, NamesOnlyInputErrorsWithoutAFile) {
  EXPECT_EQ(naming_file("a", [] { return 7; }), 7);
  EXPECT_EQ(test::input_error([] { naming_file("a", [] { throw InputError("is empty"); }); }), "a: is empty");
  EXPECT_EQ(test::input_error([] { naming_file("a", [] { throw InputError("b", "is empty"); }); }), "b: is empty");
  EXPECT_THROW(naming_file("a", [] { throw std::runtime_error("other"); }), std::runtime_error);
}

}  // namespace
}  // namespace spincat
