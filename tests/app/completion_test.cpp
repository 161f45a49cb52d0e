// Completions of command lines, as shells make them.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <string>

namespace {

struct Result {
  int code = 0;
  std::string out;
};

Result sh(const std::string& command) {
  FILE* pipe = popen(command.c_str(), "r");
  Result result;
  std::array<char, 4096> piece{};
  for (std::size_t count = 0; (count = std::fread(piece.data(), 1, piece.size(), pipe)) > 0;) {
    result.out.append(piece.data(), count);
  }
  result.code = WEXITSTATUS(pclose(pipe));
  return result;
}

const std::string kSpincat = SPINCAT_COMMAND;

// What bash offers for the last of the words.
std::string offered(const std::string& words) {
  return sh("bash -c 'source <(" + kSpincat + " completion bash); COMP_WORDS=(" + words +
            "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _spincat; echo \"${COMPREPLY[*]}\"'")
      .out;
}

TEST(Completion, OffersCommandsAndTheirOptionsToBash) {
  EXPECT_EQ(offered("spincat cl"), "classify\n");
  EXPECT_EQ(offered("spincat --ver"), "--version\n");
  EXPECT_EQ(offered("spincat classify --vot"), "--votes\n");
  EXPECT_EQ(offered("spincat train --other"), "--others --others-models\n");
}

TEST(Completion, LeavesOtherWordsToFileNames) {
  EXPECT_EQ(offered("spincat classify model"), "\n");
  EXPECT_EQ(offered("spincat nothing --vot"), "\n");
}

void expect_well_formed(const std::string& shell) {
  if (sh("command -v " + shell).code != 0) {
    GTEST_SKIP() << "there is no " << shell;
  }
  EXPECT_EQ(sh(kSpincat + " completion " + shell + " | " + shell + " -n /dev/stdin 2>&1").out, "");
}

TEST(Completion, OfZshIsWellFormed) {
  expect_well_formed("zsh");
}

TEST(Completion, OfFishIsWellFormed) {
  expect_well_formed("fish");
}

TEST(Completion, OffersOptionsToFish) {
  if (sh("command -v fish").code != 0) {
    GTEST_SKIP() << "there is no fish";
  }
  EXPECT_EQ(sh("fish -c '" + kSpincat + " completion fish | source; complete -C \"spincat classify --vot\"'").out,
            "--votes\tShow what every judge said\n");
}

TEST(Completion, OfAnotherShellIsAnError) {
  const Result result = sh(kSpincat + " completion tcsh 2>&1");
  EXPECT_EQ(result.code, 2);
  EXPECT_EQ(result.out, "spincat: there are no completions for 'tcsh' (bash, zsh or fish)\n");
}

}  // namespace
