#include <gtest/gtest.h>

#include <algorithm>

#include "dataset_lines.h"
#include "spincat/dataset/listing.h"
#include "support/expect_error.h"
#include "support/temp_dir.h"

namespace spincat {
namespace {

using test::input_error;
using test::Lines;

class Cla : public testing::Test {
 protected:
  // "FILE CLASS<PARENT<... SPLIT", files relative to the folder of the models.
  Lines listed(std::string_view text, std::string_view name = "all.cla") const {
    const Listing listing = list_cla(dir_.write(name, text), dir_.path());
    Lines lines;
    for (const ListedObject& object : listing.objects) {
      std::string line = object.file.lexically_relative(dir_.path()).string() + " ";
      for (std::optional<std::uint32_t> next = object.listed_class; next; next = listing.classes[*next].parent) {
        line += listing.classes[*next].name + "<";
      }
      lines.push_back(line + object.split);
    }
    return lines;
  }

  std::string error(std::string_view text) const {
    const std::string prefix = (dir_ / "all.cla").string() + ": ";
    const std::string message = input_error([&] { listed(text); });
    EXPECT_EQ(message.substr(0, prefix.size()), prefix);
    return message.substr(std::min(prefix.size(), message.size()));
  }

  test::TempDir dir_;
};

TEST_F(Cla, ReadsClassesAndModels) {
  EXPECT_EQ(
      listed("PSB 1\n4 4\n\nfurniture 0 0\n\nseat furniture 1\n7\n\nchair seat 2\n1120\n99\n\nsnowman 0 1\n100\n"),
      (Lines{"0/m7/m7.off seat<furniture<", "11/m1120/m1120.off chair<seat<furniture<",
             "0/m99/m99.off chair<seat<furniture<", "1/m100/m100.off snowman<"}));
}

TEST_F(Cla, TakesTheSplitFromItsName) {
  EXPECT_EQ(listed("PSB 1\r\n1 1\r\na 0 1\r\n5", "train.cla"), (Lines{"0/m5/m5.off a<train"}));
  EXPECT_EQ(listed("PSB 1 1 1 a 0 1 5", "test.cla"), (Lines{"0/m5/m5.off a<test"}));
  EXPECT_EQ(listed("PSB 1 0 0"), Lines{});
}

TEST_F(Cla, RefusesOtherFiles) {
  EXPECT_EQ(error(""), "line 1: is no Princeton classification file: expected 'PSB 1', found the end of the file");
  EXPECT_EQ(error("\nPSB 2\n"), "line 2: is no Princeton classification file: expected 'PSB 1', found '2'");
}

TEST_F(Cla, RefusesCountsThatCannotBe) {
  EXPECT_EQ(error("PSB 1\nx 1\n"), "line 2: expected the number of classes, found 'x'");
  EXPECT_EQ(error("PSB 1\n1\n"), "line 3: expected the number of models, found the end of the file");
  EXPECT_EQ(error("PSB 1\n-1 1\n"), "line 2: expected the number of classes, found '-1'");
  EXPECT_EQ(error("PSB 1\n1.5 1\n"), "line 2: expected the number of classes, found '1.5'");
  EXPECT_EQ(error("PSB 1\n4000000000 1\na 0 0\n"),
            "line 2: the number of classes is 4000000000, but only 8 bytes follow");
  EXPECT_EQ(error("PSB 1\n1 900\na 0 0\n"), "line 2: the number of models is 900, but only 6 bytes follow");
  EXPECT_EQ(error("PSB 1\n1 2\na 0 5000\n1\n2\n"),
            "line 3: the number of models of class 'a' is 5000, but only 4 bytes follow");
  EXPECT_EQ(error("PSB 1\n1 2\na 0 1\n1\n"), "line 2: announces 2 models, but the classes list 1");
}

TEST_F(Cla, RefusesModelNumbersThatCannotBe) {
  EXPECT_EQ(error("PSB 1\n1 1\na 0 1\n-4\n"), "line 4: expected model number 1 of 1 in class 'a', found '-4'");
  EXPECT_EQ(error("PSB 1\n1 1\na 0 1\n99999999999\n"),
            "line 4: expected model number 1 of 1 in class 'a', found '99999999999', which is too large");
  EXPECT_EQ(error("PSB 1\n2 3\na 0 2\n1\nb a 1\n2\n"), "line 5: expected model number 2 of 2 in class 'a', found 'b'");
}

TEST_F(Cla, RefusesClassesThatCannotBe) {
  EXPECT_EQ(error("PSB 1\n2 0\na 0 0\n"),
            "line 4: expected class 2 of 2 as NAME PARENT COUNT, found the end of the file");
  EXPECT_EQ(error("PSB 1\n2 2\na 0 1\n1\n2\nb 0 1\n3\n"),
            "line 5: expected class 2 of 2 as NAME PARENT COUNT, found '2'");
  EXPECT_EQ(error("PSB 1\n2 0\na 0 0\n\na 0 0\n"), "line 5: class 'a' is declared twice");
  EXPECT_EQ(error("PSB 1\n2 0\na b 0\nb a 0\n"), "line 3: the parent 'b' of class 'a' is not declared above it");
  EXPECT_EQ(error("PSB 1\n1 0\na a 0\n"), "line 3: the parent 'a' of class 'a' is not declared above it");
  EXPECT_EQ(error("PSB 1\n1 0\n0 0 0\n"), "line 3: a class cannot be called 0, which is the root");
  EXPECT_EQ(error("PSB 1\n1 0\na\x01 b 0\n"), "line 3: the parent 'b' of class 'a\\x01' is not declared above it");
}

TEST_F(Cla, RefusesWhatFollowsTheLastClass) {
  EXPECT_EQ(error("PSB 1\n1 1\na 0 1\n1\n2\n"), "line 5: expected the end of the file after 1 classes, found '2'");
}

TEST_F(Cla, FindsModelsBesideIt) {
  const auto cla = dir_.write("psb/classification/train.cla", "PSB 1 1 1 a 0 1 5");
  EXPECT_EQ(input_error([&] { list_cla(cla, ""); }),
            cla.string() + ": its models are not found: expected them in ../db or db beside it, or a folder named");
  std::filesystem::create_directories(dir_ / "psb/classification/db");
  EXPECT_EQ(list_cla(cla, "").objects[0].file, dir_ / "psb/classification/db/0/m5/m5.off");
  std::filesystem::create_directories(dir_ / "psb/db");
  EXPECT_EQ(list_cla(cla, "").objects[0].file, dir_ / "psb/db/0/m5/m5.off");
}

}  // namespace
}  // namespace spincat
