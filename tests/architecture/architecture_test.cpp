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

// The rooms in their order: each may include what stands before it and is named here, besides its own headers,
// error.h and execution.h (which stands above all but io/read_limits.h). The table of docs/design.md is this one.
const std::map<std::string, std::set<std::string>> kAllowed = {
    {"geometry", {}},
    {"background", {"geometry"}},
    {"files", {"geometry"}},
    {"io", {"geometry", "files"}},
    {"dataset", {"geometry", "files", "io"}},
    {"prepare", {"geometry"}},
    {"spin", {"geometry"}},
    {"encode", {"geometry", "spin"}},
    {"judge", {"geometry", "encode"}},
    {"parallel", {"geometry", "files"}},
    {"camera", {"geometry", "files", "io"}},
    {"settings", {"geometry", "background", "prepare", "spin", "encode", "judge"}},
    {"describe",
     {"geometry", "background", "io", "prepare", "spin", "encode", "judge", "parallel", "camera", "settings"}},
    {"classify",
     {"geometry", "files", "io", "prepare", "spin", "encode", "judge", "parallel", "camera", "settings", "describe"}},
    {"train",
     {"geometry", "background", "files", "io", "dataset", "prepare", "spin", "encode", "judge", "parallel", "settings",
      "describe", "classify"}},
    {"evaluate",
     {"geometry", "files", "io", "dataset", "prepare", "spin", "encode", "judge", "parallel", "camera", "settings",
      "describe", "classify", "train"}},
    {"report",
     {"geometry", "dataset", "prepare", "spin", "judge", "camera", "settings", "describe", "classify", "train",
      "evaluate"}},
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

// Those that may include execution.h, which includes io/read_limits.h.
bool knows_files(const std::string& module) {
  return module == "parallel" || kAllowed.at(module).contains("io");
}

TEST(Architecture, WhatEveryModuleMayIncludeKnowsHardlyAny) {
  const fs::path root = fs::path(SPINCAT_SOURCE_DIR) / "src/spincat";
  for (const fs::path& file : {root / "error.h", root / "execution.h"}) {
    for (const std::string& include : includes_of(file)) {
      EXPECT_TRUE(include.rfind("spincat/", 0) != 0 || include == "spincat/io/read_limits.h") << file << include;
    }
  }
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
    if (!relative
             .has_parent_path()) {  // error.h, range.h and version.h are below all; execution.h has a test of its own
      continue;
    }
    const std::string module = *relative.begin();
    ASSERT_TRUE(kAllowed.contains(module)) << module << " is a new module: add it to the table and to docs/design.md";
    for (const std::string& include : includes_of(entry.path())) {
      if (include.rfind("spincat/", 0) != 0 || include == "spincat/error.h" || include == "spincat/range.h" ||
          include == "spincat/version.h" || (include == "spincat/execution.h" && knows_files(module))) {
        continue;
      }
      const std::string other = include.substr(8, include.find('/', 8) - 8);  // a name with .h: nothing may include it
      EXPECT_TRUE(other == module || kAllowed.at(module).contains(other)) << relative << " includes " << include;
      ++seen;
    }
  }
  EXPECT_GT(seen, 50U);  // the walk did find the sources
}

TEST(Architecture, ThePythonPackageIncludesOnlyTheWholeLibrary) {
  std::size_t seen = 0;
  for (const auto& entry : fs::directory_iterator(fs::path(SPINCAT_SOURCE_DIR) / "python/src")) {
    for (const std::string& include : includes_of(entry.path())) {
      if (include.rfind("spincat/", 0) == 0) {
        EXPECT_EQ(include, "spincat/spincat.h") << entry.path();
        ++seen;
      }
    }
  }
  EXPECT_GT(seen, 0U);
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
