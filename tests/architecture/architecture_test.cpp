// The arrows of docs/design.md: which module may include which.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

// Each module and the modules whose headers it may include, besides its own and error.h.
const std::map<std::string, std::set<std::string>> kAllowed = {
    {"geometry", {}},
    {"io", {"geometry"}},
    {"dataset", {"geometry", "io"}},
    {"prepare", {"geometry"}},
    {"spin", {"geometry"}},
    {"encode", {"geometry", "spin"}},
    {"judge", {"geometry", "encode"}},
    {"parallel", {"geometry", "io"}},
    {"camera", {"geometry", "io"}},
    {"pipeline", {"geometry", "io", "dataset", "prepare", "spin", "encode", "judge", "parallel", "camera"}},
    {"report", {"geometry", "dataset", "prepare", "spin", "judge", "camera", "pipeline"}},
};

std::vector<std::string> includes_of(const fs::path& file) {
  static const std::regex pattern(R"(^\s*#\s*include\s*[<"]([^>"]+)[>"])");
  std::vector<std::string> includes;
  std::ifstream stream(file);
  std::smatch match;
  for (std::string line; std::getline(stream, line);) {
    if (std::regex_search(line, match, pattern)) {
      includes.push_back(match[1]);
    }
  }
  return includes;
}

TEST(Architecture, EveryModuleIncludesOnlyWhatItMay) {
  const fs::path root = fs::path(SPINCAT_SOURCE_DIR) / "src/spincat";
  std::size_t seen = 0;
  for (const auto& entry : fs::recursive_directory_iterator(root)) {
    const std::string extension = entry.path().extension();
    if (extension != ".h" && extension != ".cpp") {
      continue;
    }
    const fs::path relative = entry.path().lexically_relative(root);
    if (relative == "error.h") {
      continue;
    }
    const std::string module = *relative.begin();
    ASSERT_TRUE(kAllowed.contains(module)) << module << " is a new module: add it to the table and to docs/design.md";
    for (const std::string& include : includes_of(entry.path())) {
      if (include.rfind("spincat/", 0) != 0 || include == "spincat/error.h") {
        continue;
      }
      const std::string other = include.substr(8, include.find('/', 8) - 8);
      EXPECT_TRUE(other == module || kAllowed.at(module).contains(other)) << relative << " includes " << include;
      ++seen;
    }
  }
  EXPECT_GT(seen, 50U);  // the walk did find the sources
}

TEST(Architecture, OnlyParallelKnowsMpiAndOnlyTheCommandPrints) {
  const fs::path root = fs::path(SPINCAT_SOURCE_DIR) / "src/spincat";
  for (const auto& entry : fs::recursive_directory_iterator(root)) {
    if (!entry.is_regular_file()) {
      continue;
    }
    const std::string module = *entry.path().lexically_relative(root).begin();
    for (const std::string& include : includes_of(entry.path())) {
      EXPECT_TRUE(include != "mpi.h" || module == "parallel") << entry.path();
      EXPECT_NE(include, "iostream") << entry.path();
    }
  }
}

}  // namespace
