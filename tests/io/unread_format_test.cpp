#include "spincat/io/unread_format.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "io/reading.h"
#include "spincat/io/read_object.h"

namespace spincat {
namespace {

using test::problem_with;

TEST(UnreadFormat, SaysWhichProgramConvertsAFile) {
  EXPECT_EQ(problem_with("a.laz", "LASF"),
            "spincat does not read LAZ files; convert it with PDAL: pdal translate a.laz a.las");
  EXPECT_EQ(problem_with("A.STEP", "ISO-10303-21;"),
            "spincat does not read STEP files; convert it with gmsh: gmsh a.step -2 -o a.stl");
  EXPECT_EQ(problem_with("a.fbx", ""), "spincat does not read FBX files; Blender exports it as glTF");
  EXPECT_EQ(problem_with("a.obj.gz", "x"), "spincat does not read gzip files; unpack it first");
  EXPECT_EQ(problem_with("a.skp", "x"),
            "spincat does not read SketchUp files; the program that made it exports it as STL");
}

TEST(UnreadFormat, KnowsAModelAndAMissingFileFirst) {
  EXPECT_EQ(problem_with("a.step", std::string("SPINCAT\x1a\x01\x02", 10)), "is a spincat model, not an object");
  const test::TempDir dir;
  EXPECT_THROW(read_object(dir / "missing.step"), InputError);
  try {
    read_object(dir / "missing.step");
  } catch (const InputError& error) {
    EXPECT_EQ(error.problem(), "no such file");
  }
}

TEST(UnreadFormat, KnowsTheUsualOnes) {
  for (const char* extension :
       {".laz", ".step", ".stp", ".iges", ".igs", ".e57", ".fbx", ".dae", ".bag", ".blend", ".3ds",
        ".max", ".skp",  ".usd", ".usdz", ".vtk", ".vtp", ".wrl", ".x3d", ".gz",  ".zip"}) {
    EXPECT_TRUE(unread_format(extension)) << extension;
  }
  EXPECT_FALSE(unread_format(".off"));
  EXPECT_FALSE(unread_format(".jpg"));
  EXPECT_FALSE(unread_format(""));
}

TEST(UnreadFormat, NamesNothingTwiceAndNothingThatIsRead) {
  std::set<std::string_view> seen;
  for (const UnreadFormat& format : unread_formats()) {
    EXPECT_TRUE(seen.insert(format.extension).second) << format.extension;
    EXPECT_FALSE(is_object_file("a" + std::string(format.extension))) << format.extension;
    EXPECT_TRUE(format.extension.starts_with('.')) << format.extension;
    EXPECT_FALSE(format.advice.empty() || format.name.empty()) << format.extension;
  }
}

}  // namespace
}  // namespace spincat
