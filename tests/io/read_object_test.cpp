#include "spincat/io/read_object.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "reading.h"
#include "spincat/error.h"

namespace spincat {
namespace {

using test::problem_with;

std::string message_of(const std::filesystem::path& file) {
  try {
    read_object(file);
  } catch (const InputError& error) {
    return error.what();
  }
  return "(nothing thrown)";
}

TEST(ReadObject, PutsTheFileBeforeTheProblem) {
  const test::TempDir dir;
  const auto file = dir.write("chair.off", "OFF\n1 0 0\n0 0 x\n");
  EXPECT_EQ(message_of(file), file.string() + ": line 3: expected a coordinate, found 'x'");
}

TEST(ReadObject, GoesByTheExtensionInEitherCase) {
  test::expect_sound(test::read_bytes("A.OFF", "OFF 1 0 0\n0 0 0\n"));
  test::expect_sound(test::read_bytes("a.b.Obj", "v 0 0 0\n"));
}

TEST(ReadObject, SaysWhatElseItWasGiven) {
  const test::TempDir dir;
  std::filesystem::create_directory(dir / "folder.off");
  EXPECT_EQ(message_of(dir / "folder.off"), (dir / "folder.off").string() + ": is a folder, not an object");
  EXPECT_EQ(message_of(dir.path()), dir.path().string() + ": is a folder, not an object");
  EXPECT_EQ(message_of(dir / "missing.off"), (dir / "missing.off").string() + ": no such file");
  EXPECT_EQ(message_of(dir / "missing"), (dir / "missing").string() + ": no such file");
}

// Whatever the name ends in: one that tells no format is looked at in another way.
TEST(ReadObject, SaysWhyAFileCannotBeRead) {
  const test::TempDir dir;
  dir.write("file", "x");
  for (const std::string ending : {"", ".off", ".abc"}) {
    const std::string loop = (dir / ("loop" + ending)).string();
    std::filesystem::create_symlink(loop, loop);
    EXPECT_EQ(message_of(loop), loop + ": too many levels of symbolic links");
    const std::string below = (dir / "file").string() + "/below" + ending;
    EXPECT_EQ(message_of(below), below + ": not a directory");
    const std::string endless = std::string(300, 'a') + ending;
    EXPECT_EQ(message_of(endless), endless + ": file name too long");
    if (::geteuid() == 0) {
      continue;  // root reads everything
    }
    const auto shut = dir.write("shut" + ending + "/a" + ending, "x");
    std::filesystem::permissions(shut.parent_path(), std::filesystem::perms::none);
    EXPECT_EQ(message_of(shut), shut.string() + ": permission denied");
    std::filesystem::permissions(shut.parent_path(), std::filesystem::perms::owner_all);
  }
}

TEST(ReadObject, RecognisesAModel) {
  const std::string model("SPINCAT\x1a\x01\x02", 10);
  EXPECT_EQ(problem_with("a.off", model), "is a spincat model, not an object");
  EXPECT_EQ(problem_with("a.spincat", model), "is a spincat model, not an object");
  EXPECT_EQ(problem_with("a", model), "is a spincat model, not an object");
}

TEST(ReadObject, NamesTheFormatsItReads) {
  EXPECT_TRUE(problem_with("a.abc", "x").starts_with("unknown format '.abc'; spincat reads .off, .obj"));
  EXPECT_TRUE(problem_with("a", "x").starts_with("has no extension that tells its format; spincat reads .off, "));
}

TEST(ObjectExtensions, AreThoseOfObjectFiles) {
  EXPECT_TRUE(is_object_file("folder/a.off"));
  EXPECT_TRUE(is_object_file("A.OBJ"));
  EXPECT_FALSE(is_object_file("a.txt"));  // notes, unless read_object is asked
  EXPECT_FALSE(is_object_file("a.png"));
  EXPECT_FALSE(is_object_file("off"));
  EXPECT_FALSE(is_object_file(".off"));
  for (const std::string& extension : object_extensions()) {
    EXPECT_TRUE(is_object_file("a" + extension)) << extension;
  }
}

}  // namespace
}  // namespace spincat
