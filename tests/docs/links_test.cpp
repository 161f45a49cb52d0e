// Every relative link of a Markdown page leads to a file of the project.
#include <gtest/gtest.h>

#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

std::string contents(const fs::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::vector<fs::path> pages() {
  const fs::path root = SPINCAT_SOURCE_DIR;
  std::vector<fs::path> files = {root / "README.md", root / "CONTRIBUTING.md", root / "CHANGELOG.md"};
  for (const char* folder : {"docs", "tools", "examples"}) {
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      if (entry.path().extension() == ".md") {
        files.push_back(entry.path());
      }
    }
  }
  return files;
}

// "#how-an-image-is-made" for "## How an image is made?", as GitHub forms it.
std::set<std::string> anchors(const std::string& page) {
  static const std::regex heading(R"((?:^|\n)#+ ([^\n]+))");
  std::set<std::string> names;
  for (std::sregex_iterator at(page.begin(), page.end(), heading), end; at != end; ++at) {
    std::string name;
    for (const char c : (*at)[1].str()) {
      if (c == ' ' || c == '-') {
        name += '-';
      } else if (c == '_' || static_cast<signed char>(c) < 0 || std::isalnum(static_cast<unsigned char>(c)) != 0) {
        name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
      }
    }
    names.insert(name);
  }
  return names;
}

TEST(Docs, EveryLinkLeadsToAFileAndAHeadingOfIt) {
  static const std::regex link(R"(\]\(([^)\s#]*)(?:#([^)\s]*))?\))");
  std::size_t seen = 0;
  for (const fs::path& file : pages()) {
    const std::string page = contents(file);
    for (std::sregex_iterator at(page.begin(), page.end(), link), end; at != end; ++at) {
      const std::string target = (*at)[1];
      if (target.find("://") != std::string::npos) {
        continue;
      }
      const fs::path leads_to = target.empty() ? file : file.parent_path() / target;
      ++seen;
      ASSERT_TRUE(fs::exists(leads_to)) << file << " links to " << target;
      if ((*at)[2].length() > 0) {
        EXPECT_TRUE(anchors(contents(leads_to)).contains((*at)[2])) << file << " links to " << (*at).str();
      }
    }
  }
  EXPECT_GT(seen, 30U);
}

// "docs/guide/camera.md" in a source or a script is a page, too.
TEST(Docs, EveryPageThatASourceNamesIsThere) {
  static const std::regex name(R"(docs/[a-z/-]+\.md)");
  const fs::path root = SPINCAT_SOURCE_DIR;
  std::size_t seen = 0;
  for (const char* folder : {"src", "app", "tests", "bench", "cmake", "experiments", "scripts", "tools", "examples"}) {
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      const fs::path& file = entry.path();
      if (!entry.is_regular_file() || fs::file_size(file) > 200'000) {
        continue;
      }
      const std::string text = contents(file);
      for (std::sregex_iterator at(text.begin(), text.end(), name), end; at != end; ++at) {
        ++seen;
        EXPECT_TRUE(fs::exists(root / at->str())) << file << " names " << at->str();
      }
    }
  }
  EXPECT_GT(seen, 20U);
}

}  // namespace
