// Models are data: what the command does with one that was made to do harm.
#include "spincat/classify/model.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

#include "spincat/classify/model_data.h"
#include "support/temp_dir.h"

namespace {

namespace fs = std::filesystem;

std::string contents(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

class HostileModel : public testing::Test {
 protected:
  // Runs a command of the shell in the temporary folder; its exit code. What it printed lies in the files out and err.
  int run(const std::string& line) {
    const int status =
        std::system(fmt::format("cd '{}' && {} >out 2>err </dev/null", dir_.path().string(), line).c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }

  // A model that works, whose texts try to steer a terminal, to leave their page and to name files.
  void SetUp() override {
    for (int i = 0; i < 3; ++i) {
      dir_.write(fmt::format("shapes/a/{}.xyz", i), fmt::format("0 0 0\n{} 0 0\n0 1 0\n0 0 1\n1 1 1\n", i + 1));
      dir_.write(fmt::format("shapes/b/{}.xyz", i), fmt::format("0 0 0\n9 0 {}\n0 1 0\n8 1 1\n7 2 1\n", i + 1));
    }
    ASSERT_EQ(
        run(std::string(SPINCAT_COMMAND) +
            " train shapes -o good.spincat --copies 0 --background 4 --points 64 --spin-points 8 --surface vertices"),
        0)
        << contents(dir_ / "err");
    spincat::ModelData model = spincat::read_model(dir_ / "good.spincat").data();
    model.categories = {"\x1B[31m\x1B]0;title\x07 </script><script>alert(1)</script>", "../../../etc/passwd"};
    model.dataset = "\x1B[2J/etc/shadow";
    model.made_by = "$(touch made) `touch made` \x1B[2J";
    spincat::write_model(dir_ / "hostile.spincat", model);
  }

  const spincat::test::TempDir dir_;
};

TEST_F(HostileModel, NeverSteersTheTerminalNorLeavesItsPage) {
  const std::string command = SPINCAT_COMMAND;
  for (const std::string& line :
       {command + " info hostile.spincat", command + " classify hostile.spincat shapes/a/0.xyz --votes",
        command + " classify hostile.spincat shapes --json", command + " info hostile.spincat --json",
        command + " classify hostile.spincat shapes/b/0.xyz --report page.html"}) {
    EXPECT_EQ(run(line), 0) << line << contents(dir_ / "err");
    const std::string printed = contents(dir_ / "out") + contents(dir_ / "err");
    EXPECT_TRUE(std::ranges::none_of(printed, [](char c) { return c >= 0 && c < ' ' && c != '\n'; })) << printed;
  }
  EXPECT_EQ(contents(dir_ / "page.html").find("<script>alert"), std::string::npos);
  EXPECT_FALSE(fs::exists(dir_ / "made"));
}

// Under strace, where there is one: of all files outside the system's own folders the command opens the model alone,
// and it starts nothing. A leak sanitizer cannot work beside strace.
TEST_F(HostileModel, ReadingOneOpensAndRunsNothingElse) {
  if (run("strace -f -e trace=openat,open,execve,creat -o trace true") != 0) {
    GTEST_SKIP() << "strace is missing, or may not trace here";
  }
  ASSERT_EQ(
      run(fmt::format(
          "ASAN_OPTIONS=detect_leaks=0 strace -f -e trace=openat,open,execve,creat -o trace '{}' info hostile.spincat",
          SPINCAT_COMMAND)),
      0);
  const std::regex opened(R"((openat\(AT_FDCWD, |open\(|creat\()\"([^\"]*)\")");
  std::vector<std::string> files;
  std::size_t started = 0;
  std::ifstream trace(dir_ / "trace");
  for (std::string line; std::getline(trace, line);) {
    started += line.find("execve(") != std::string::npos ? 1 : 0;
    std::smatch match;
    if (!std::regex_search(line, match, opened)) {
      continue;
    }
    const std::string file = match[2];
    const bool of_system =
        std::ranges::any_of(std::vector<std::string>{"/etc/ld", "/lib", "/usr/lib", "/proc", "/sys", "/tmp/tsan."},
                            [&](const auto& folder) { return file.starts_with(folder); });
    if (!of_system) {
      files.push_back(file);
    }
  }
  EXPECT_EQ(started, 1U);
  std::ranges::sort(files);
  files.erase(std::ranges::unique(files).begin(), files.end());
  EXPECT_EQ(files, std::vector<std::string>{"hostile.spincat"});
}

}  // namespace
