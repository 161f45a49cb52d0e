// The Princeton Shape Benchmark's furniture, grouped by data/psb-furniture.csv: in small always, in full where
// SPINCAT_PSB names a folder with classification/ and db/.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdlib>
#include <map>

#include "dataset_lines.h"
#include "spincat/dataset/dataset.h"
#include "support/expect_error.h"
#include "support/temp_dir.h"

namespace spincat {
namespace {

namespace fs = std::filesystem;
using test::Lines;
using test::object_lines;
using Counts = std::map<std::string, int>;

const DatasetOptions kFurniture{.models = {}, .category_map = fs::path(SPINCAT_SOURCE_DIR) / "data/psb-furniture.csv"};

Counts counts_of(const Dataset& dataset, std::string_view split = "") {
  Counts counts;
  for (const DatasetObject& object : dataset.objects) {
    counts[dataset.categories[object.category]] += split.empty() || object.split == split ? 1 : 0;
  }
  return counts;
}

// The benchmark's hierarchy with a model or two in each class; model N is only there for N < 50.
class SmallPsb : public testing::Test {
 protected:
  SmallPsb() {
    dir_.write(
        "classification/train.cla",
        "PSB 1\n13 14\n\nanimal 0 1\n60\n\nfurniture 0 0\n\nbed furniture 2\n1\n2\n\nseat furniture 0\n\n"
        "chair seat 0\n\ndining_chair chair 1\n3\n\ncouch seat 1\n4\n\nstool chair 1\n5\n\nshelves furniture 1\n6\n\n"
        "table furniture 1\n7\n\nrectangular table 2\n8\n9\n\nround table 1\n10\n\n"
        "table_and_chairs furniture 3\n11\n12\n13\n");
    dir_.write(
        "classification/test.cla",
        "PSB 1\n10 9\n\nfurniture 0 0\ncabinet furniture 2\n21\n51\nschool_desk furniture 1\n22\nseat furniture 0\n"
        "bench seat 1\n23\ndesk_chair seat 1\n24\ndining_chair seat 1\n25\ntable furniture 0\nround table 0\n"
        "single_leg round 3\n26\n27\n28\n");
    for (int model = 0; model < 50; ++model) {
      dir_.write(fmt::format("db/0/m{0}/m{0}.off", model), "");
    }
  }
  test::TempDir dir_;
};

TEST_F(SmallPsb, IsReadAsAFolder) {
  dir_.write("classification/._train.cla", "not for us");
  const Dataset dataset = read_dataset({dir_.path()}, kFurniture);
  EXPECT_EQ(counts_of(dataset),
            (Counts{{"bed", 2}, {"cabinet", 1}, {"chair", 3}, {"couch", 1}, {"shelf", 1}, {"table", 7}}));
  EXPECT_EQ(test::skipped_lines(dataset, dir_.path()), (Lines{"db/0/m51/m51.off: no such file"}));
}

TEST_F(SmallPsb, IsReadByItsFiles) {
  const Dataset folder = read_dataset({dir_.path()}, kFurniture);
  const Dataset files = read_dataset({dir_ / "classification/train.cla", dir_ / "classification/test.cla"}, kFurniture);
  EXPECT_EQ(object_lines(files, dir_.path()), object_lines(folder, dir_.path()));
  EXPECT_EQ(counts_of(files, "train"),
            (Counts{{"bed", 2}, {"cabinet", 0}, {"chair", 2}, {"couch", 1}, {"shelf", 1}, {"table", 4}}));
}

TEST_F(SmallPsb, HasItsOwnClassesWithoutAMap) {
  const Dataset dataset = read_dataset({dir_ / "classification/train.cla"});
  EXPECT_EQ(dataset.categories, (Lines{"bed", "couch", "dining_chair", "rectangular", "round", "shelves", "stool",
                                       "table", "table_and_chairs"}));
}

TEST_F(SmallPsb, TakesTheNearestAncestorThatAMapLists) {
  const fs::path map = dir_.write("map.csv", "class,category\nfurniture,other\nseat,seat\nchair,chair\n");
  const Dataset dataset = read_dataset({dir_ / "classification/train.cla"}, {.models = {}, .category_map = map});
  EXPECT_EQ(counts_of(dataset), (Counts{{"other", 10}, {"seat", 1}, {"chair", 2}}));
}

TEST_F(SmallPsb, RefusesAClassificationThatIsNoFile) {
  ASSERT_EQ(::mkfifo((dir_ / "classification/more.cla").c_str(), 0600), 0);  // reading it would wait for ever
  EXPECT_EQ(test::input_error([&] { read_dataset({dir_.path()}); }),
            (dir_ / "classification/more.cla").string() + ": is not a regular file");
}

TEST(Psb, FurnitureHasThePublishedCounts) {
  const char* const folder = std::getenv("SPINCAT_PSB");
  if (folder == nullptr) {
    GTEST_SKIP() << "SPINCAT_PSB does not name a folder with the Princeton Shape Benchmark's furniture";
  }
  const Dataset dataset = read_dataset({folder}, kFurniture);
  EXPECT_EQ(counts_of(dataset),
            (Counts{{"bed", 8}, {"cabinet", 9}, {"chair", 29}, {"couch", 15}, {"shelf", 26}, {"table", 69}}));
  EXPECT_EQ(dataset.objects.size(), 156U);
  EXPECT_TRUE(dataset.skipped.empty());
  const fs::path classification = fs::path(folder) / "classification";
  EXPECT_EQ(object_lines(read_dataset({classification / "test.cla", classification / "train.cla"}, kFurniture), folder),
            object_lines(dataset, folder));
}

}  // namespace
}  // namespace spincat
