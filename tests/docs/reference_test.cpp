// The generated pages are those of this build. With SPINCAT_WRITE_REFERENCE they are written instead of compared, which
// is what scripts/reference does.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "docs/reference_pages.h"

namespace {

namespace fs = std::filesystem;

void compare_or_write(const std::string& name, const std::string& generated) {
  const fs::path file = fs::path(SPINCAT_SOURCE_DIR) / "docs/reference" / name;
  if (std::getenv("SPINCAT_WRITE_REFERENCE") != nullptr) {
    std::ofstream(file) << generated;
  }
  std::ifstream stream(file);
  const std::string committed{std::istreambuf_iterator<char>(stream), {}};
  EXPECT_EQ(committed, generated) << file << " is not what this build says; scripts/reference writes it anew";
}

TEST(Reference, CommandPageIsWhatHelpPrints) {
  const std::string page = spincat::test::command_page(SPINCAT_COMMAND);
  EXPECT_NE(page.find("## spincat train\n"), std::string::npos);
  EXPECT_NE(page.find("## spincat camera\n"), std::string::npos);
  compare_or_write("command.md", page);
}

TEST(Reference, SettingsPageIsWhatTheCommandLists) {
  const std::string page = spincat::test::settings_page(SPINCAT_COMMAND);
  EXPECT_NE(page.find("| `spin_points` | `--spin-points` |"), std::string::npos);
  compare_or_write("settings.md", page);
}

}  // namespace
