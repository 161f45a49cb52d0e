#include "spincat/dataset/object_files.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "support/temp_dir.h"

namespace spincat {
namespace {

namespace fs = std::filesystem;
using Paths = std::vector<fs::path>;

TEST(ObjectFiles, AreFoundInAllFoldersBelow) {
  const test::TempDir dir;
  for (const char* name : {"b.off", "deep/er/a.OBJ", "notes.txt", "deep/c.ply"}) {
    dir.write(name, "");
  }
  const ObjectFiles found = object_files_below(dir.path());
  EXPECT_EQ(found.files, (Paths{dir / "b.off", dir / "deep/c.ply", dir / "deep/er/a.OBJ"}));
  EXPECT_TRUE(found.unread_folders.empty());
  EXPECT_TRUE(found.unread_files.empty());
}

TEST(ObjectFiles, ThoseInFormatsThatAreNotReadAreCounted) {
  const test::TempDir dir;
  for (const char* name : {"a.off", "a.step", "deep/b.STEP", "c.stp", "d.blend", "notes.md", "wood.jpg"}) {
    dir.write(name, "");
  }
  const ObjectFiles found = object_files_below(dir.path());
  EXPECT_EQ(found.files, Paths{dir / "a.off"});
  EXPECT_EQ(found.unread_files.text(), "4 files in formats that spincat does not read: .step 2, .blend 1, .stp 1");
}

TEST(ObjectFiles, AreTextFilesOfNumbers) {
  const test::TempDir dir;
  dir.write("a.txt", "0 0 0\n0 0 1\n0 1 0\n1 0 0\n1 1 1\n");
  dir.write("list.txt", "a.txt\nb.txt\n");
  ASSERT_EQ(::mkfifo((dir / "pipe.txt").c_str(), 0600), 0);  // opening it would wait for ever
  EXPECT_EQ(object_files_below(dir.path()).files, Paths{dir / "a.txt"});
}

TEST(ObjectFiles, LostLinksCountButFoldersPipesDevicesAndLinksToFoldersDoNot) {
  const test::TempDir dir;
  fs::create_symlink("nowhere", dir / "lost.off");
  fs::create_directories(dir / "folder.off");
  ASSERT_EQ(::mkfifo((dir / "pipe.off").c_str(), 0600), 0);  // reading it would wait for ever
  fs::create_symlink("/dev/zero", dir / "endless.off");
  fs::create_symlink(dir.path(), dir / "circle.off");
  EXPECT_EQ(object_files_below(dir.path()).files, Paths{dir / "lost.off"});
}

TEST(ObjectFiles, AFolderThatCannotBeReadIsToldAndTheOthersAreFound) {
  const test::TempDir dir;
  dir.write("a.off", "");
  const ObjectFiles absent = object_files_below(dir / "absent");
  EXPECT_EQ(absent.files, Paths{});
  ASSERT_EQ(absent.unread_folders.size(), 1U);
  EXPECT_EQ(absent.unread_folders[0].folder, dir / "absent");
  EXPECT_EQ(absent.unread_folders[0].error, std::errc::no_such_file_or_directory);
  if (::geteuid() == 0) {
    return;  // root reads every folder
  }
  dir.write("shut/b.off", "");
  ASSERT_EQ(::chmod((dir / "shut").c_str(), 0), 0);
  const ObjectFiles found = object_files_below(dir.path());
  EXPECT_EQ(found.files, Paths{dir / "a.off"});
  EXPECT_EQ(found.unread_folders.size(), 1U);
  ::chmod((dir / "shut").c_str(), 0700);
}

}  // namespace
}  // namespace spincat
