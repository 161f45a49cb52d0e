#include "spincat/io/read_object.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>

#include "bytes.h"
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

const std::string kPly =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
const std::string kOff = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
const std::string kObj = "# made by hand\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
const std::string kStl =
    "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
    "endsolid a\n";
const std::string kPcd = "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z\nPOINTS 3\nDATA ascii\n0 0 0\n1 0 0\n0 1 0\n";
const std::string kXyz = "0 0 0\n1 0 0\n0 1 0\n1 1 0.5\n2 2 2\n";
const std::string kGltf =
    R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],)"
    R"("accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":3}],)"
    R"("bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,)"
    R"(AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";

std::string binary_stl() {
  std::string bytes(80, ' ');
  bytes += test::little(std::uint32_t{1});
  bytes += test::little_row<float>(0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0);
  return bytes + std::string(2, '\0');
}

// The bytes of ASCII as UTF-16 has them.
std::string utf16(const std::string& text, bool is_big, bool with_mark) {
  std::string bytes;
  for (const char16_t unit : (with_mark ? u"\xFEFF" : u"") + std::u16string(text.begin(), text.end())) {
    bytes += is_big ? test::big(unit) : test::little(unit);
  }
  return bytes;
}

TEST(ReadObject, GoesByAContentThatIsPlainlyAnother) {
  for (const std::string name : {"a.obj", "a.ply", "a.stl", "a.pcd", "a.xyz", "a.gltf", "a.glb", "a.txt"}) {
    for (const std::string& mesh : {kPly, kOff, kObj, kStl, binary_stl(), kGltf}) {
      EXPECT_EQ(std::get<Mesh>(test::read_bytes(name, mesh)).triangles.size(), 1U) << name << mesh;
    }
    EXPECT_EQ(test::read_cloud(name, kPcd).points.size(), 3U) << name;
    EXPECT_EQ(test::read_cloud(name, kXyz).points.size(), 5U) << name;
  }
  EXPECT_EQ(test::read_mesh("a.off", kPly).triangles.size(), 1U);
}

TEST(ReadObject, SaysWhichFormatItTakesAContentFor) {
  EXPECT_EQ(problem_with("a.obj", kPly.substr(0, kPly.size() - 3)),
            "its content looks like PLY: line 13: a list of 3 values does not fit into the rest of the file");
  EXPECT_EQ(problem_with("a.stl", "OFF\n1 0 0\nx 0 0 0"),
            "its content looks like OFF: line 3: expected a coordinate, found 'x'");
}

TEST(ReadObject, NamesWhatItDoesNotRead) {
  EXPECT_EQ(problem_with("a.obj", "PK\x03\x04..."), "is a zip archive");
  EXPECT_EQ(problem_with("a.stl", "Kaydara FBX Binary  "), "is an FBX file");
  EXPECT_EQ(problem_with("a.off", "version https://git-lfs.github.com/spec/v1\n"),
            "is a pointer of Git LFS; 'git lfs pull' fetches the file itself");
  EXPECT_EQ(problem_with("a.ply", "<!DOCTYPE html><html>"), "is a web page");
  EXPECT_EQ(problem_with("a.xyz", "<?xml version=\"1.0\"?>\n<COLLADA>"), "is an XML file");
  EXPECT_EQ(problem_with("a.obj", "PKs\n"), "holds neither a face nor a point");
}

// Numbers alone may be an OFF file without its first line.
TEST(ReadObject, LeavesNumbersToTheFormatThatTheNameTells) {
  const std::string numbers = "3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  EXPECT_EQ(test::read_mesh("a.off", numbers).triangles.size(), 1U);
  EXPECT_EQ(problem_with("a.xyz", numbers), "line 5: one value more than in line 1");
}

TEST(ReadObject, ReadsUtf16) {
  for (const bool is_big : {false, true}) {
    for (const bool with_mark : {false, true}) {
      for (const auto& [name, text] :
           {std::pair("a.obj", kObj), std::pair("a.off", kOff), std::pair("a.ply", kPly), std::pair("a.stl", kStl),
            std::pair("a.gltf", kGltf), std::pair("a.xyz", kPly)}) {
        EXPECT_EQ(test::read_mesh(name, utf16(text, is_big, with_mark)).triangles.size(), 1U) << name;
      }
      EXPECT_EQ(test::read_cloud("a.xyz", utf16(kXyz, is_big, with_mark)).points.size(), 5U);
      EXPECT_EQ(test::read_cloud("a.pcd", utf16(kPcd, is_big, with_mark)).points.size(), 3U);
    }
  }
}

TEST(ReadObject, NamesTheFormatsItReads) {
  EXPECT_TRUE(problem_with("a.abc", "x").starts_with("unknown format '.abc'; spincat reads .off, .obj"));
  EXPECT_TRUE(problem_with("a", "x").starts_with("has no extension that tells its format; spincat reads .off, "));
}

class TextFiles : public testing::Test {
 protected:
  bool is_meant(std::string_view text) const { return is_object_file(dir_.write("a.txt", text)); }
  test::TempDir dir_;
};

TEST_F(TextFiles, AreObjectsWhereTheirLinesAreNumbers) {
  for (const std::string_view row : {"0.5 1 -2e3\n", "1,2,3\n", "0;1;2\r\n", "1 2 3 0 0 1\n", "0,5 1,25 2,0\n",
                                     "nan nan nan\n", "1\t2\t3 # a point\n"}) {
    std::string rows;
    for (int i = 0; i < 5; ++i) {
      rows += row;
    }
    EXPECT_TRUE(is_meant(rows)) << row;
    EXPECT_TRUE(is_meant("# points\n\n" + rows + "\n// end")) << row;
    EXPECT_TRUE(is_meant("5\n" + rows)) << row;
    EXPECT_TRUE(is_meant("5\n" + rows + "5\n" + rows)) << row;
    EXPECT_TRUE(is_meant("x,y,z,r\n" + rows)) << row;
  }
  EXPECT_TRUE(is_meant(utf16(kXyz, false, true)));
}

TEST_F(TextFiles, AreNotesWhereTheyHoldAnythingElse) {
  for (const std::string_view notes :
       {"", "\n", "These boxes were made by hand.\n", "ball\nbox\nchair\ntable\nsofa\nbed\n", "1\n2\n3\n4\n5\n6\n",
        "0 ball\n1 box\n2 chair\n3 table\n4 bed\n5 sofa\n", "1 2\n3 4\n5 6\n7 8\n9 10\n", "2024 11 30\n",
        "1 0 0 0.5\n0 1 0 0.25\n0 0 1 0\n0 0 0 1\n", "1 2 3\n1 2 3\n1 2 3\n1 2 3\n1 2 3\nthat was it\n",
        "see x, y, z\nof all\n"}) {
    EXPECT_FALSE(is_meant(notes)) << notes;
  }
}

TEST_F(TextFiles, AreLookedAtInTheirFirstLinesOnly) {
  std::string rows;
  while (rows.size() < 100'000) {
    rows += "1 2 3.5\n";
  }
  EXPECT_TRUE(is_meant(rows + "the end\n"));
  EXPECT_FALSE(is_meant("begin\n" + rows));
  EXPECT_FALSE(is_meant(std::string(100'000, '1')));
}

// Opening a pipe would wait for ever.
TEST_F(TextFiles, AreRegularOnes) {
  ASSERT_EQ(::mkfifo((dir_ / "pipe.txt").c_str(), 0600), 0);
  std::filesystem::create_directory(dir_ / "folder.txt");
  std::filesystem::create_symlink("nowhere", dir_ / "lost.txt");
  std::filesystem::create_symlink("/dev/zero", dir_ / "endless.txt");
  for (const char* name : {"pipe.txt", "folder.txt", "lost.txt", "endless.txt", "absent.txt"}) {
    EXPECT_FALSE(is_object_file(dir_ / name)) << name;
    EXPECT_TRUE(has_object_name(dir_ / name)) << name;
  }
}

TEST(ObjectExtensions, AreThoseOfObjectFiles) {
  EXPECT_TRUE(is_object_file("folder/a.off"));
  EXPECT_TRUE(is_object_file("A.OBJ"));
  EXPECT_FALSE(is_object_file("a.png"));
  EXPECT_FALSE(is_object_file("off"));
  EXPECT_FALSE(is_object_file(".off"));
  for (const std::string& extension : object_extensions()) {
    EXPECT_TRUE(is_object_file("a" + extension)) << extension;
  }
}

TEST(ReadObject, TellsWhichPointsItLeftOut) {
  using Rows = std::vector<std::uint32_t>;
  EXPECT_EQ(test::read_cloud("a.xyz", "0 0 0\n# a scan\nnan 0 0\n1 2 3\n0 inf 0\n").left_out, (Rows{1, 3}));
  EXPECT_EQ(test::read_cloud("a.off", "OFF\n3 0 0\nnan 0 0\n1 2 3\n4 5 6\n").left_out, (Rows{0}));
  EXPECT_EQ(test::read_mesh("a.off", "OFF\n4 1 0\n0 0 0\nnan 0 0\n1 0 0\n0 1 0\n3 0 2 3\n").left_out, (Rows{1}));
  EXPECT_EQ(test::read_cloud("a.ply",
                             "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty "
                             "float z\nend_header\n0 0 0\n1 2 3\nnan nan nan\n")
                .left_out,
            (Rows{2}));
  EXPECT_TRUE(test::read_cloud("a.xyz", "0 0 0\n1 2 3\n").left_out.empty());
}

}  // namespace
}  // namespace spincat
