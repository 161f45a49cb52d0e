#include "spincat/dataset/dataset.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "dataset_lines.h"
#include "support/expect_error.h"
#include "support/temp_dir.h"

namespace spincat {
namespace {

namespace fs = std::filesystem;
using test::input_error;
using test::Lines;
using test::object_lines;
using test::skipped_lines;

class DatasetTest : public testing::Test {
 protected:
  Lines objects(const std::vector<fs::path>& sources, const DatasetOptions& options = {}) const {
    return object_lines(read_dataset(sources, options), root_);
  }
  std::string error(const std::vector<fs::path>& sources, const DatasetOptions& options = {}) const {
    return input_error([&] { read_dataset(sources, options); });
  }
  std::string name(std::string_view file) const { return (dir_ / file).string(); }

  test::TempDir dir_;
  fs::path root_ = dir_.path();
};

TEST_F(DatasetTest, ReadsCsv) {
  dir_.write("a.off", "");
  dir_.write("b c.off", "");
  const fs::path csv = dir_.write("set.csv",
                                  "# mine\nsplit,note,path,category\ntest,x,a.off,table\n,,\"b c.off\",\"chair, big\"\n"
                                  ",,gone.off,lamp\n,,set.csv,lamp\n,,.,lamp\n");
  const Dataset dataset = read_dataset({csv});
  EXPECT_EQ(object_lines(dataset, root_), (Lines{"a.off table test", "b c.off chair, big"}));
  EXPECT_EQ(dataset.categories, (Lines{"chair, big", "table"}));
  EXPECT_EQ(skipped_lines(dataset, root_),
            (Lines{"gone.off: no such file", "set.csv: objects of this format are not read (extension '.csv')",
                   ".: is a folder"}));
}

TEST_F(DatasetTest, ReadsTheColumnsThatListsInUseHave) {
  dir_.write("a.off", "");
  dir_.write("b.off", "");
  const Lines expected{"a.off table", "b.off chair"};
  for (const std::string_view header :
       {"path,category", "filename,label", "file,class", "File_Path,Class", "FILE , CATEGORY"}) {
    EXPECT_EQ(objects({dir_.write("set.csv", std::string(header) + "\na.off,table\nb.off,chair\n")}), expected)
        << header;
  }
  EXPECT_EQ(objects({dir_.write("set.csv", "path;category\na.off;table\nb.off;chair\n")}), expected);
  EXPECT_EQ(objects({dir_.write("set.tsv", "path\tcategory\na.off\ttable\nb.off\tchair\n")}), expected);
  EXPECT_EQ(
      objects({dir_.write("set.csv", "class,object_id,object_path,split\ntable,1,a.off,train\nchair,2,b.off,test\n")}),
      (Lines{"a.off table train", "b.off chair test"}));
}

TEST_F(DatasetTest, TakesBackslashesForFoldersWhereAFileIsFoundSo) {
  dir_.write("chairs/old/a.off", "");
  dir_.write("b\\c.off", "");
  dir_.write("b/c.off", "");
  const fs::path csv =
      dir_.write("set.csv", "path,category\nchairs\\old\\a.off,chair\nb\\c.off,table\nC:\\gone.off,table\n");
  const Dataset dataset = read_dataset({csv});
  EXPECT_EQ(object_lines(dataset, root_), (Lines{"b\\c.off table", "chairs/old/a.off chair"}));
  EXPECT_EQ(skipped_lines(dataset, root_), Lines{"C:\\gone.off: no such file"});
}

TEST_F(DatasetTest, MeansTheTextFilesThatAListNames) {
  dir_.write("a.txt", "0 0 0\n");
  dir_.write("b.txt", "notes");
  const fs::path csv = dir_.write("set.csv", "path,category\na.txt,table\nb.txt,chair\n");
  EXPECT_EQ(objects({csv}), (Lines{"a.txt table", "b.txt chair"}));
}

TEST_F(DatasetTest, FindsCsvPathsBelowModelsOrAbsolute) {
  dir_.write("models/a.off", "");
  dir_.write("b.off", "");
  const fs::path csv = dir_.write("set.csv", "path,category\na.off,table\n" + name("b.off") + ",chair\n");
  EXPECT_EQ(objects({csv}, {.models = dir_ / "models", .category_map = {}}),
            (Lines{"b.off chair", "models/a.off table"}));
  EXPECT_EQ(error({csv}, {.models = dir_ / "other", .category_map = {}}),
            name("other") + ": no such folder (expected the folder that holds the models)");
}

TEST_F(DatasetTest, NamesTheLineOfACsvThatIsWrong) {
  const fs::path csv = dir_.write("set.csv", "path,category\na.off,\n");
  EXPECT_EQ(error({csv}), name("set.csv") + ": line 2: the category is empty");
}

TEST_F(DatasetTest, RefusesWhatIsNoDataset) {
  const std::string kinds =
      "a data set is a folder with a sub-folder for each category, a CSV file (.csv) with the columns path,category, "
      "or "
      "a classification file (.cla) of the Princeton Shape Benchmark";
  EXPECT_EQ(error({}), "no data set is named");
  EXPECT_EQ(error({dir_ / "gone"}), name("gone") + ": no such file or folder");
  EXPECT_EQ(error({dir_.write("a.off", "")}), name("a.off") + ": is one object, not a data set: " + kinds);
  EXPECT_EQ(error({dir_.write("a.txt", "")}), name("a.txt") + ": is not a data set: " + kinds);
}

TEST_F(DatasetTest, TellsWhyNoObjectIsLeft) {
  const fs::path csv = dir_.write("set.csv", "path,category\na.off,table\nb.off,chair\n");
  EXPECT_EQ(error({csv}),
            name("set.csv") + ": no object is left; 2 skipped, the first is " + name("a.off") + " (no such file)");
  EXPECT_EQ(error({dir_.write("set.csv", "path,category\n")}), name("set.csv") + ": no object is left");
}

// A million rows of four bytes would take a gigabyte.
TEST_F(DatasetTest, RefusesAListThatIsFarLargerInMemory) {
  std::string rows = "path,category\n";
  for (int i = 0; i < 1'000'000; ++i) {
    rows += "a,b\n";
  }
  const std::string line = error({dir_.write("set.csv", rows)});
  EXPECT_TRUE(line.starts_with(name("set.csv") + ": would take ")) << line;
  EXPECT_TRUE(line.ends_with("bytes and 16 MB; --max-growth raises this limit")) << line;
}

TEST_F(DatasetTest, ShowsStrangePathsInALine) {
  EXPECT_EQ(
      error({dir_.write("set.csv", "path,category\n\"a\nb.off\",table\n")}),
      name("set.csv") + ": no object is left; 1 skipped, the first is " + name("a\\x0ab.off") + " (no such file)");
}

// A file that two sources name differently is kept under the name that sorts first, whichever source comes first.
TEST_F(DatasetTest, MergesSources) {
  dir_.write("x/table/a.off", "");
  dir_.write("x/chair/b.off", "");
  dir_.write("c.off", "");
  const fs::path csv = dir_.write(
      "set.csv", "path,category,split\nx/chair/../table/a.off,table,test\nx/chair/b.off,chair,\nc.off,bed,\n");
  const Dataset dataset = read_dataset({csv, dir_ / "x"});
  EXPECT_EQ(dataset.name, name("set.csv") + ", " + name("x"));
  ASSERT_EQ(dataset.objects.size(), 3U);
  EXPECT_EQ(dataset.objects[1].file, dir_ / "x/chair/../table/a.off");
  EXPECT_EQ(dataset.objects[1].split, "test");
  EXPECT_EQ(objects({dir_ / "x", csv}), object_lines(dataset, root_));
}

TEST_F(DatasetTest, RefusesSourcesThatContradictEachOther) {
  dir_.write("a.off", "");
  dir_.write("b.off", "");
  const fs::path one = dir_.write("one.csv", "path,category,split\na.off,table,train\nb.off,chair,\n");
  const fs::path two = dir_.write("two.csv", "path,category\na.off,desk\n");
  const fs::path three = dir_.write("three.csv", "path,category,split\na.off,table,test\n");
  EXPECT_EQ(error({one, two}),
            name("a.off") + ": is of category 'table' in " + name("one.csv") + " but of 'desk' in " + name("two.csv"));
  EXPECT_EQ(error({one, three}),
            name("a.off") + ": is of split 'train' in " + name("one.csv") + " but of 'test' in " + name("three.csv"));
}

TEST_F(DatasetTest, MapsCategories) {
  for (const char* file : {"desk/a.off", "stool/b.off", "chair/c.off", "lamp/d.off"}) {
    dir_.write("set/" + std::string(file), "");
  }
  const fs::path map =
      dir_.write("map.csv", "# seats\nclass,category\nstool,seat\nchair,seat\nchair,seat\ndesk,desk\nsofa,seat\n");
  const Dataset dataset = read_dataset({dir_ / "set"}, {.models = {}, .category_map = map});
  EXPECT_EQ(object_lines(dataset, root_),
            (Lines{"set/chair/c.off seat", "set/desk/a.off desk", "set/stool/b.off seat"}));
  EXPECT_EQ(skipped_lines(dataset, root_), (Lines{"map.csv: no class of the data set is called 'sofa'"}));
}

TEST_F(DatasetTest, RefusesMapsThatAreWrong) {
  dir_.write("set/chair/c.off", "");
  const auto map_error = [&](std::string_view text) {
    return error({dir_ / "set"}, {.models = {}, .category_map = dir_.write("map.csv", text)});
  };
  EXPECT_EQ(map_error("class,category\na,b\na,c\n"),
            name("map.csv") + ": line 3: class 'a' goes to 'c' here and to 'b' above");
  EXPECT_EQ(map_error("class,category\n"), name("map.csv") + ": lists no class below its header line");
  EXPECT_EQ(map_error("class,category\na,\n"), name("map.csv") + ": line 2: the category is empty");
  EXPECT_EQ(map_error("name,category\n"), name("map.csv") +
                                              ": the header line names no column 'class' (found: 'name', 'category'; "
                                              "commas, semicolons or tabs separate columns)");
  EXPECT_EQ(map_error("class,category\nx,y\n"), name("set") + ": no object is left; 1 skipped, the first is " +
                                                    name("map.csv") + " (no class of the data set is called 'x')");
}

}  // namespace
}  // namespace spincat
