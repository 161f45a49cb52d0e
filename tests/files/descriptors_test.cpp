// Reading and writing, in all the ways that they can fail, leaves no file open.
#include <gtest/gtest.h>

#include <filesystem>
#include <iterator>

#include "spincat/error.h"
#include "spincat/files/file.h"
#include "spincat/files/output_file.h"
#include "spincat/io/read_object.h"
#include "support/shapes.h"
#include "support/temp_dir.h"

namespace spincat {
namespace {

namespace fs = std::filesystem;

std::ptrdiff_t open_files() {
  return std::distance(fs::directory_iterator("/proc/self/fd"), {});
}

TEST(Descriptors, AreClosedWhateverHappens) {
  if (!fs::exists("/proc/self/fd")) {
    GTEST_SKIP() << "this system does not tell which files are open";
  }
  const test::TempDir dir;
  dir.write("good.off", test::off_text(test::box()));
  for (const char* name :
       {"empty.off", "bad.off", "bad.obj", "bad.ply", "bad.stl", "bad.pcd", "bad.xyz", "bad.glb", "bad.gltf"}) {
    dir.write(name, name[0] == 'e' ? "" : "neither this nor that");
  }
  fs::create_directory(dir / "folder.off");
  fs::create_symlink("nowhere", dir / "lost.off");
  const std::ptrdiff_t before = open_files();
  for (int round = 0; round < 50; ++round) {
    int refused = 0;
    for (const fs::directory_entry& entry : fs::directory_iterator(dir.path())) {
      try {
        read_object(entry.path());
      } catch (const InputError&) {
        ++refused;
      }
    }
    EXPECT_EQ(refused, 11 + (round > 0 ? 1 : 0));  // the result of the round before is none, either
    write_file_atomically(dir / "result.off", "whole");
    OutputFile(dir / "result.off").write("half");
    EXPECT_THROW(write_file_atomically(dir / "folder.off", "x"), InputError);
    EXPECT_THROW(write_file_atomically("/dev/full", "x"), RunError);
  }
  EXPECT_EQ(open_files(), before);
}

}  // namespace
}  // namespace spincat
