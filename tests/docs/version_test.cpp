// One version everywhere: CMakeLists.txt has it, and what people read repeats it.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>

#include "support/shell.h"

namespace {

// The first thing in a file of the project that the pattern's group matches.
std::string found_in(const std::string& file, const std::string& pattern) {
  std::ifstream stream(std::filesystem::path(SPINCAT_SOURCE_DIR) / file);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  std::smatch match;
  return std::regex_search(text, match, std::regex(pattern)) ? match[1].str() : "(nothing)";
}

TEST(Version, IsTheSameEverywhere) {
  const std::string version = found_in("CMakeLists.txt", R"(project\(spincat VERSION (\S+))");
  EXPECT_EQ(found_in("CITATION.cff", R"(\nversion: (\S+))"), version);
  EXPECT_EQ(found_in("CHANGELOG.md", R"(\n## (\d\S*) - )"), version);
  EXPECT_EQ(found_in("CHANGELOG.md", R"(\n## \d\S* - (\S+))"), found_in("CITATION.cff", R"(\ndate-released: (\S+))"));
  const std::string minor = version.substr(0, version.rfind('.'));
  for (const char* example : {"train_and_name", "spin_images", "depth_camera"}) {
    const std::string file = "examples/" + std::string(example) + "/CMakeLists.txt";
    EXPECT_EQ(found_in(file, R"(find_package\(spincat (\S+) )"), minor) << file;
  }
  for (const char* page : {"README.md", "docs/start.md", "docs/guide/train.md"}) {
    EXPECT_EQ(found_in(page, R"(made by +spincat (\S+))"), version) << page;
  }
}

TEST(Version, IsToldWithWhatTheBuildCanDo) {
  const spincat::test::ShellResult told = spincat::test::run_in_shell(SPINCAT_COMMAND " --version");
  EXPECT_EQ(told.code, 0);
  EXPECT_EQ(told.out.substr(0, told.out.find('\n')),
            "spincat " + found_in("CMakeLists.txt", R"(project\(spincat VERSION (\S+))"));
  for (const char* part :
       {"\nbuilt with ", "\nspin images ", ", portable)", "\nMPI ", "\nKinect ", ".ply", "\nmodels "}) {
    EXPECT_NE(told.out.find(part), std::string::npos) << part << " in\n" << told.out;
  }
}

}  // namespace
