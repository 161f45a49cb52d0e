#include "spincat/dataset/parts.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "spincat/dataset/object_files.h"
#include "support/expect_error.h"
#include "support/temp_dir.h"

namespace spincat {
namespace {

namespace fs = std::filesystem;
using test::input_error;
using test::TempDir;
using Names = std::vector<std::string>;

Dataset data() {
  return {"data",
          {"bed", "chair", "lamp"},
          {{"a/1", 0, "train"}, {"a/2", 0, "test"}, {"a/3", 1, "train"}, {"a/4", 1, "val"}, {"a/5", 2, "test"}},
          {}};
}

Names files_of(const Dataset& dataset) {
  Names files;
  for (const DatasetObject& object : dataset.objects) {
    files.push_back(object.file.string() + " " + dataset.categories[object.category]);
  }
  return files;
}

TEST(WithEnoughObjects, LeavesSmallCategoriesOutAndSaysWhy) {
  std::vector<LeftOutCategory> left_out;
  const Dataset part = with_enough_objects(data(), 2, left_out);
  EXPECT_EQ(part.categories, (Names{"bed", "chair"}));
  EXPECT_EQ(files_of(part), (Names{"a/1 bed", "a/2 bed", "a/3 chair", "a/4 chair"}));
  ASSERT_EQ(left_out.size(), 1U);
  EXPECT_EQ(left_out[0].name, "lamp");
  EXPECT_EQ(left_out[0].reason, "has 1 object");
  left_out.clear();
  EXPECT_EQ(files_of(with_enough_objects(data(), 1, left_out)), files_of(data()));
  EXPECT_TRUE(left_out.empty());
}

TEST(TestingPart, IsWhatIsMarkedTest) {
  EXPECT_EQ(files_of(testing_part(data())), (Names{"a/2 bed", "a/5 lamp"}));
  EXPECT_EQ(files_of(training_part(data())), (Names{"a/1 bed", "a/3 chair"}));
}

TEST(TestingPart, RefusesADataSetWithoutASplit) {
  Dataset none = data();
  Dataset all = data();
  for (std::size_t i = 0; i < none.objects.size(); ++i) {
    none.objects[i].split = "";
    all.objects[i].split = "test";
  }
  EXPECT_EQ(input_error([&] { testing_part(none); }), "data: has no split of its own: no object is marked 'test'");
  EXPECT_EQ(input_error([&] { testing_part(all); }), "data: has no split of its own: every object is marked 'test'");
}

TEST(CommonCategories, AreMatchedByNameInOneOrder) {
  const Dataset other = {
      "other", {"car", "chair", "lamp"}, {{"b/1", 0, ""}, {"b/2", 1, ""}, {"b/3", 2, ""}, {"b/4", 1, ""}}, {}};
  std::vector<LeftOutCategory> left_out;
  const auto [train, test] = common_categories(data(), other, left_out);
  EXPECT_EQ(train.categories, (Names{"chair", "lamp"}));
  EXPECT_EQ(test.categories, train.categories);
  EXPECT_EQ(files_of(train), (Names{"a/3 chair", "a/4 chair", "a/5 lamp"}));
  EXPECT_EQ(files_of(test), (Names{"b/2 chair", "b/3 lamp", "b/4 chair"}));
  ASSERT_EQ(left_out.size(), 2U);
  EXPECT_EQ(left_out[0].name + " " + left_out[0].reason, "bed is not in other");
  EXPECT_EQ(left_out[1].name + " " + left_out[1].reason, "car is not in data");
}

TEST(CommonCategories, RefuseTooFewAndObjectsInBoth) {
  std::vector<LeftOutCategory> left_out;
  const Dataset other = {"other", {"chair", "sofa"}, {{"b/1", 0, ""}, {"b/2", 1, ""}}, {}};
  EXPECT_EQ(input_error([&] { common_categories(data(), other, left_out); }),
            "other: shares only category 'chair' with data: two or more categories are needed");
  EXPECT_EQ(input_error([&] { common_categories(data(), data(), left_out); }),
            "a/1: is in both data sets: an object that is tested must not be learned from");
}

TEST(ListChecksum, DoesNotMindWhereTheDataLiesOrItsOrder) {
  Dataset moved = data();
  for (DatasetObject& object : moved.objects) {
    object.file = "/some/where" / object.file;
  }
  std::ranges::reverse(moved.objects);
  const std::string checksum = list_checksum(data().objects, data().categories);
  EXPECT_EQ(checksum.size(), 8U);
  EXPECT_EQ(list_checksum(moved.objects, moved.categories), checksum);
}

TEST(ListChecksum, MindsFilesCategoriesAndSplits) {
  const std::string checksum = list_checksum(data().objects, data().categories);
  Dataset other = data();
  other.objects[0].file = "a/6";
  EXPECT_NE(list_checksum(other.objects, other.categories), checksum);
  other = data();
  other.objects[0].category = 1;
  EXPECT_NE(list_checksum(other.objects, other.categories), checksum);
  other = data();
  other.objects[0].split = "";
  EXPECT_NE(list_checksum(other.objects, other.categories), checksum);
  EXPECT_EQ(list_checksum({}, {}), "00000000");
}

TEST(ReadObjects, TakesAFolderOrTheColumnPathOfACsv) {
  const TempDir dir;
  dir.write("in/b.off", "");
  dir.write("in/deep/a.ply", "");
  dir.write("in/notes.txt", "");
  const auto csv = dir.write("list.csv", "path,kind\nz.off,car\na.off,\nz.off,car\n");
  EXPECT_EQ(read_objects(dir / "in"), (std::vector<fs::path>{dir / "in/b.off", dir / "in/deep/a.ply"}));
  EXPECT_EQ(read_objects(csv), (std::vector<fs::path>{dir / "a.off", dir / "z.off"}));
  EXPECT_EQ(read_objects(csv, "m"), (std::vector<fs::path>{"m/a.off", "m/z.off"}));
}

TEST(ReadObjects, RefusesWhatNamesNone) {
  const TempDir dir;
  dir.write("empty/notes.txt", "");
  EXPECT_EQ(input_error([&] { read_objects(dir / "empty"); }), (dir / "empty").string() + ": names no object");
  const auto csv = dir.write("list.csv", "path\n");
  EXPECT_EQ(input_error([&] { read_objects(csv); }), csv.string() + ": names no object");
  EXPECT_EQ(input_error([&] { read_objects(dir / "absent"); }), (dir / "absent").string() + ": no such file");
}

}  // namespace
}  // namespace spincat
