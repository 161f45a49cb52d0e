#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "dataset_lines.h"
#include "spincat/dataset/dataset.h"
#include "support/expect_error.h"
#include "support/temp_dir.h"

namespace spincat {
namespace {

namespace fs = std::filesystem;
using test::input_error;
using test::Lines;
using test::object_lines;
using test::skipped_lines;

TEST(FolderDataset, TakesSubFoldersAsCategories) {
  const test::TempDir dir;
  for (const char* name : {"table/b.off", "chair/z.off", "chair/deep/er/a.OBJ", "chair/z.jpg", "chair/.hidden.off",
                           ".git/c.off", "notes.txt", "table/.thumbs/t.off"}) {
    dir.write(name, "");
  }
  const Dataset dataset = read_dataset({dir.path()});
  EXPECT_EQ(dataset.name, dir.path().string());
  EXPECT_EQ(dataset.categories, (Lines{"chair", "table"}));
  EXPECT_EQ(object_lines(dataset, dir.path()),
            (Lines{"chair/deep/er/a.OBJ chair", "chair/z.off chair", "table/b.off table"}));
  EXPECT_EQ(skipped_lines(dataset, dir.path()), Lines{});
}

TEST(FolderDataset, TakesTextFilesOfNumbersForClouds) {
  const test::TempDir dir;
  const std::string cloud = "0,0,0\n0,0,1\n0,1,0\n1,0,0\n1,1,1\n";
  for (const char* name : {"chair/a.txt", "chair/deep/B.TXT", "table/c.txt", "stray.txt"}) {
    dir.write(name, cloud);
  }
  dir.write("chair/notes.txt", "made by hand");
  dir.write("chair/ids.txt", "1\n2\n3\n4\n5\n");
  dir.write("classes.txt", "chair\ntable\n");
  const Dataset dataset = read_dataset({dir.path()});
  EXPECT_EQ(object_lines(dataset, dir.path()),
            (Lines{"chair/a.txt chair", "chair/deep/B.TXT chair", "table/c.txt table"}));
  EXPECT_EQ(skipped_lines(dataset, dir.path()), Lines{"stray.txt: lies in no category's sub-folder"});
}

TEST(FolderDataset, TakesSplitsAroundCategories) {
  const test::TempDir dir;
  for (const char* name : {"train/chair/a.off", "test/chair/b.off", "val/table/c.off", "validation/table/d.off"}) {
    dir.write(name, "");
  }
  EXPECT_EQ(object_lines(read_dataset({dir.path()}), dir.path()),
            (Lines{"test/chair/b.off chair test", "train/chair/a.off chair train", "val/table/c.off table val",
                   "validation/table/d.off table validation"}));
}

TEST(FolderDataset, TakesSplitsInsideCategories) {
  const test::TempDir dir;
  for (const char* name : {"chair/train/a.off", "chair/test/x/b.off", "chair/c.off", "table/x/train/d.off"}) {
    dir.write(name, "");
  }
  EXPECT_EQ(object_lines(read_dataset({dir.path()}), dir.path()),
            (Lines{"chair/c.off chair", "chair/test/x/b.off chair test", "chair/train/a.off chair train",
                   "table/x/train/d.off table"}));
}

TEST(FolderDataset, TellsWhatItPassedOver) {
  const test::TempDir dir;
  for (const char* name : {"chair/a.off", "table/b.off", "stray.off", "train/stray.obj", "images/c.png"}) {
    dir.write(name, "");
  }
  fs::create_symlink("nowhere", dir / "chair/lost.off");
  EXPECT_EQ(skipped_lines(read_dataset({dir.path()}), dir.path()),
            (Lines{"images: holds no object files", "stray.off: lies in no category's sub-folder",
                   "train/stray.obj: lies in no category's sub-folder", "chair/lost.off: no such file"}));
}

TEST(FolderDataset, CountsObjectsInFormatsThatAreNotRead) {
  const test::TempDir dir;
  for (const char* name : {"chair/a.off", "table/b.off", "chair/c.step", "table/deep/d.step", "e.fbx"}) {
    dir.write(name, "");
  }
  EXPECT_EQ(skipped_lines(read_dataset({dir.path()}), dir.path()),
            Lines{".: holds 3 files in formats that spincat does not read: .step 2, .fbx 1"});
}

TEST(FolderDataset, TellsAFolderOfOtherFormatsFromAnEmptyOne) {
  const test::TempDir dir;
  dir.write("chair/a.step", "");
  EXPECT_NE(input_error([&] { read_dataset({dir.path()}); })
                .find("; 1 file in a format that spincat does not read: "
                      ".step 1)"),
            std::string::npos);
}

TEST(FolderDataset, NeedsTwoCategories) {
  const test::TempDir dir;
  const std::string name = dir.path().string();
  const std::string expected =
      "expected a sub-folder for each category, with .off, .obj, ... files, or train and test folders of such";
  EXPECT_EQ(input_error([&] { read_dataset({dir.path()}); }), name + ": holds no objects (" + expected + ")");
  dir.write("a.off", "");
  EXPECT_EQ(input_error([&] { read_dataset({dir.path()}); }),
            name + ": holds no objects (" + expected + "; objects outside such sub-folders: 1)");
  dir.write("chair/a.off", "");
  EXPECT_EQ(input_error([&] { read_dataset({dir.path()}); }),
            name + ": only one category ('chair'): two or more are needed; 1 skipped, the first is " + name +
                "/a.off (lies in no category's sub-folder)");
}

TEST(CsvDataset, AFileThatIsMissingIsToldWhereTooLittleIsLeft) {
  const test::TempDir dir;
  dir.write("a.off", "");
  const fs::path list = dir.write("list.csv", "path,category\na.off,chair\nb.off,table\n");
  EXPECT_EQ(input_error([&] { read_dataset({list}); }),
            list.string() + ": only one category ('chair'): two or more are needed; 1 skipped, the first is " +
                (dir / "b.off").string() + " (no such file)");
}

// A name may hold anything, and be as long as a field of a list.
TEST(FolderDataset, ShowsAStrangeCategoryInALine) {
  const test::TempDir dir;
  dir.write("a.off", "");
  const fs::path list =
      dir.write("list.csv", "path,category\na.off,\"a\nb\x1B[2J" + std::string(100'000, 'c') + "\"\n");
  EXPECT_EQ(input_error([&] { read_dataset({list}); }), list.string() + ": only one category ('a\\x0ab\\x1b[2J" +
                                                            std::string(67, 'c') + "...'): two or more are needed");
}

TEST(FolderDataset, FollowsLinkedFoldersButNotInCircles) {
  const test::TempDir dir;
  dir.write("set/chair/a.off", "");
  dir.write("set/table/b.off", "");
  dir.write("elsewhere/c.off", "");
  fs::create_directory_symlink(dir / "elsewhere", dir / "set/stool");
  fs::create_directory_symlink(".", dir / "set/chair/self");
  fs::create_directory_symlink("..", dir / "elsewhere/up");
  fs::create_directory_symlink("..", dir / "set/table/up");
  fs::create_symlink("loop", dir / "set/chair/loop");
  EXPECT_EQ(object_lines(read_dataset({dir / "set"}), dir / "set"),
            (Lines{"chair/a.off chair", "stool/c.off stool", "table/b.off table"}));
}

TEST(FolderDataset, EndsWhereManyFoldersLinkToEachOther) {
  const test::TempDir dir;
  for (const char* category : {"chair", "table"}) {
    for (int i = 0; i < 12; ++i) {
      const fs::path folder = dir.path() / category / std::to_string(i);
      fs::create_directories(folder);
      for (int j = 0; j < 12; ++j) {
        fs::create_directory_symlink(fs::path("..") / std::to_string(j), folder / ("to" + std::to_string(j)));
      }
    }
    dir.write(std::string(category) + "/7/a.off", "");
  }
  EXPECT_EQ(read_dataset({dir.path()}).objects.size(), 2U);
}

TEST(FolderDataset, RefusesOneFileInTwoCategories) {
  const test::TempDir dir;
  dir.write("chair/a.off", "");
  fs::create_directory_symlink("chair", dir / "table");
  const std::string root = dir.path().string();
  EXPECT_EQ(input_error([&] { read_dataset({dir.path()}); }), root + "/chair/a.off: is of category 'chair' in " + root +
                                                                  " but of 'table' in " + root + " (there called '" +
                                                                  root + "/table/a.off')");
}

TEST(FolderDataset, KeepsNamesThatAreNotUtf8) {
  const test::TempDir dir;
  dir.write("st\xFChle/\xE4.off", "");
  dir.write("tische/b.off", "");
  const Dataset dataset = read_dataset({dir.path()});
  EXPECT_EQ(dataset.categories, (Lines{"st\xFChle", "tische"}));
  EXPECT_EQ(dataset.objects[0].file, dir / "st\xFChle/\xE4.off");
}

// As another user, because root may read everything.
TEST(FolderDataset, RefusesFoldersThatCannotBeRead) {
  const test::TempDir dir;
  dir.write("chair/a.off", "");
  dir.write("table/locked/b.off", "");
  ASSERT_EQ(::chmod(dir.path().c_str(), 0755), 0);
  ASSERT_EQ(::chmod((dir / "table/locked").c_str(), 0), 0);
  const bool is_root = ::geteuid() == 0;
  ASSERT_TRUE(!is_root || ::seteuid(65534) == 0);
  const std::string error = input_error([&] { read_dataset({dir.path()}); });
  ASSERT_TRUE(!is_root || ::seteuid(0) == 0);
  EXPECT_EQ(error, (dir / "table/locked").string() + ": cannot be read: Permission denied");
  ::chmod((dir / "table/locked").c_str(), 0755);
}

}  // namespace
}  // namespace spincat
