#include "spincat/describe/describe_tasks.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

#include "spincat/error.h"
#include "spincat/evaluate/tested_objects.h"
#include "support/copies.h"
#include "support/shapes.h"
#include "support/temp_dir.h"
#include "support/tiny_dataset.h"

namespace spincat {
namespace {

namespace fs = std::filesystem;

Object some_box() {
  return test::box();
}

FeatureVector one_number(const Object&, int, StageSeconds&) {
  return {{1.0F}, {1}, "none", 0};
}

TEST(DescribeObject, GivesEveryRow) {
  const Described described = describe_object(some_box, 3, one_number);
  EXPECT_EQ(described.features.size(), 3U);
  EXPECT_EQ(described.problem, "");
}

// A journal is a file: whatever it holds must not be copied beyond a row.
TEST(Described, PassesThroughBytesAndNoOthersDo) {
  Described described;
  described.features = {{{1.0F, 2.0F, 3.0F}, {1, 2}, "encoding", 0}, {{4.0F}, {1}, "encoding", 5}};
  const std::string bytes = pack(described);
  const Described back = unpack_described(bytes);
  ASSERT_EQ(back.features.size(), 2U);
  EXPECT_EQ(back.features[0].values, described.features[0].values);
  EXPECT_EQ(back.features[0].blocks, described.features[0].blocks);
  EXPECT_EQ(back.features[1].values, described.features[1].values);
  EXPECT_EQ(back.features[1].local_size, 5U);
  EXPECT_TRUE(view_described(bytes).head.features[0].values.empty());
  const std::string twelve("\x0C\0\0\0\0\0\0\0", 8);  // bytes of three numbers
  std::string half = bytes;
  half.replace(half.find(twelve), 8, std::string("\x0B\0\0\0\0\0\0\0", 8));
  EXPECT_THROW(view_described(half), RunError);
}

TEST(DescribeObject, MakesAProblemOfWhatTheObjectIsToBlameFor) {
  const auto unread = [](const auto& error) {
    return describe_object([&]() -> Object { throw error; }, 2, one_number).problem;
  };
  EXPECT_EQ(unread(InputError("a.off", "is empty")), "is empty");
  EXPECT_EQ(unread(RunError("a.off", "not enough memory to read it")), "not enough memory to read it");
  EXPECT_EQ(unread(std::bad_alloc()), "not enough memory for it");
  const auto second_row_fails = [](const auto& error) {
    return describe_object(some_box, 2, [&](const Object& object, int row, StageSeconds& seconds) {
      if (row == 1) {
        throw error;
      }
      return one_number(object, row, seconds);
    });
  };
  for (const Described& described :
       {second_row_fails(InputError("has no extent")), second_row_fails(std::bad_alloc())}) {
    EXPECT_NE(described.problem, "");
    EXPECT_TRUE(described.features.empty());
  }
}

// A rank that is lost, say: the next object would not fare better.
TEST(DescribeObject, ThrowsWhatTheObjectIsNotToBlameFor) {
  EXPECT_THROW(describe_object(some_box, 1, [](auto&&...) -> FeatureVector { throw RunError("lost"); }), RunError);
  EXPECT_THROW(describe_object([]() -> Object { throw std::logic_error("no"); }, 1, one_number), std::logic_error);
}

class ListedObjects : public testing::Test {
 protected:
  ListedObjects() {
    dir_.write("good.off", test::off_text(test::box()));
    EXPECT_EQ(::mkfifo((dir_ / "pipe.off").c_str(), 0600), 0);
    fs::create_symlink("/dev/zero", dir_ / "endless.off");
    fs::create_symlink("loop.off", dir_ / "loop.off");
    fs::create_directory(dir_ / "folder.off");
    for (const char* name : {"good.off", "pipe.off", "endless.off", "loop.off", "folder.off", "missing.off"}) {
      files_.push_back(dir_ / name);
    }
  }

  const std::vector<std::string> problems_ = {"",
                                              "is not a regular file",
                                              "is not a regular file",
                                              "too many levels of symbolic links",
                                              "is a folder, not an object",
                                              "no such file"};
  test::TempDir dir_;
  std::vector<fs::path> files_;
};

// Nobody writes to the pipe, and the device never ends.
TEST_F(ListedObjects, MustBeRegularFilesToBeDescribed) {
  LocalFarm farm(2);
  const Settings settings = test::tiny_settings();
  const auto file = [&](std::size_t i) -> const fs::path& { return files_[i]; };
  const DescribeJob job{files_.size(), file, settings, 1, WorkSplit::encode_remotely, {}, {}};
  std::vector<std::string> problems;
  describe_files(farm.farm(), job,
                 [&](std::size_t, const Described& described, std::span<const FeatureBytes>) {
                   problems.push_back(described.problem);
                 },
                 {});
  EXPECT_EQ(problems, problems_);
}

TEST_F(ListedObjects, MustBeRegularFilesToBeTested) {
  std::vector<DatasetObject> objects;
  for (const fs::path& file : files_) {
    objects.push_back({file, 0, ""});
  }
  const Settings settings = test::tiny_settings();
  const std::size_t length = test::describe_copy(test::box(), settings, 0).values.size();
  EXPECT_EQ(describe_tested(objects, {}, static_cast<Eigen::Index>(length), settings, {}, {.threads = 2}).problems,
            problems_);
}

}  // namespace
}  // namespace spincat
