// What the command shows on a terminal: a pseudo-terminal of a given width stands in for one.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <string>

#include "app/on_terminal.h"
#include "spincat/report/text_table.h"
#include "support/shapes.h"
#include "support/temp_dir.h"

namespace spincat {
namespace {

// Everything that a command that succeeds writes to a terminal.
std::string on_terminal(const std::filesystem::path& folder, unsigned short columns, const std::string& environment,
                        const std::string& arguments) {
  const test::OnTerminal ran = test::on_terminal(folder, columns, environment, arguments);
  EXPECT_EQ(ran.code, 0) << ran.text;
  return ran.text;
}

std::string without_colours(std::string text) {
  for (std::size_t at = text.find('\033'); at != std::string::npos; at = text.find('\033')) {
    text.erase(at, text.find('m', at) + 1 - at);
  }
  return text;
}

class Terminal : public testing::Test {
 protected:
  void SetUp() override {
    for (int i = 0; i < 4; ++i) {
      const std::string name = "a category with a long name of a box";
      dir_.write(fmt::format("shapes/{}/{}.off", name, i), test::off_text(test::box(1.0 + 0.1 * i, 1.0, 1.2)));
      dir_.write(fmt::format("shapes/cone/{}.off", i), test::off_text(test::cylinder(16, 0.5, 0.0, 1.0 + 0.1 * i)));
    }
  }

  const std::string small_ =
      " --copies 0 --background 4 --points 200 --spin-points 16 --image-width 8 --bin-size 0.25 --threads 1";
  test::TempDir dir_;
};

TEST_F(Terminal, TheMatrixIsColouredUnlessTheUserSaysNo) {
  const std::string evaluate = "evaluate shapes --splits 2 --quiet" + small_;
  const std::string coloured = on_terminal(dir_.path(), 80, "env -u NO_COLOR TERM=xterm", evaluate);
  EXPECT_NE(coloured.find("\033[1;32m100\033[0m"), std::string::npos) << coloured;
  EXPECT_LE(widest_line(without_colours(coloured)), 80U) << coloured;
  EXPECT_NE(coloured.find("…"), std::string::npos) << "the long name is not cut\n" << coloured;
  for (const char* const plain : {"env NO_COLOR=1 TERM=xterm", "env -u NO_COLOR TERM=dumb"}) {
    const std::string text = on_terminal(dir_.path(), 80, plain, evaluate);
    EXPECT_EQ(text.find('\033'), std::string::npos) << plain << "\n" << text;
    EXPECT_NE(text.find("mean-class rate"), std::string::npos) << text;
  }
  EXPECT_NE(on_terminal(dir_.path(), 80, "env NO_COLOR= TERM=xterm", evaluate).find('\033'), std::string::npos);
}

TEST_F(Terminal, AnswersFitAndPipesGetWholeNames) {
  on_terminal(dir_.path(), 80, "", "train shapes -o m.spincat --quiet" + small_);
  const std::string folder = "a folder with a name that is far too long for a terminal of eighty columns";
  const std::string file = folder + "/a file with a long name.off";
  dir_.write(file, test::off_text(test::box(1.0, 1.1, 1.2)));
  const std::string text = on_terminal(dir_.path(), 80, "", fmt::format("classify m.spincat '{}'", file));
  EXPECT_LE(widest_line(text), 80U) << text;
  EXPECT_NE(text.find("a folder"), std::string::npos) << text;
  const std::string piped = on_terminal(dir_.path(), 80, "", fmt::format("classify m.spincat '{}' | cat", file));
  EXPECT_NE(piped.find(file + "  a category with a long name of a box "), std::string::npos) << piped;
}

TEST_F(Terminal, EveryHelpFitsEightyColumns) {
  for (const char* const command : {"", "train", "classify", "evaluate", "sweep", "spin", "info"}) {
    const std::string on_tty = on_terminal(dir_.path(), 80, "", fmt::format("{} --help", command));
    EXPECT_LE(widest_line(on_tty), 80U) << on_tty;
    EXPECT_EQ(on_terminal(dir_.path(), 200, "", fmt::format("{} --help | cat", command)), on_tty);  // 80 in a pipe
  }
  EXPECT_GT(widest_line(on_terminal(dir_.path(), 100, "", "train --help")), 80U);
}

}  // namespace
}  // namespace spincat
