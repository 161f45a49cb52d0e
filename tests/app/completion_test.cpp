// Completions of command lines, as shells make them.
#include <gtest/gtest.h>

#include <string>

#include "support/shell.h"

namespace {

using spincat::test::run_in_shell;
using spincat::test::ShellResult;

const std::string kSpincat = SPINCAT_COMMAND;

// What bash offers for the last of the words.
std::string offered(const std::string& words) {
  return run_in_shell("bash -c 'source <(" + kSpincat + " completion bash); COMP_WORDS=(" + words +
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
  if (run_in_shell("command -v " + shell).code != 0) {
    GTEST_SKIP() << "there is no " << shell;
  }
  EXPECT_EQ(run_in_shell(kSpincat + " completion " + shell + " | " + shell + " -n /dev/stdin 2>&1").out, "");
}

TEST(Completion, OfZshIsWellFormed) {
  expect_well_formed("zsh");
}

TEST(Completion, OfFishIsWellFormed) {
  expect_well_formed("fish");
}

TEST(Completion, OffersOptionsToFish) {
  if (run_in_shell("command -v fish").code != 0) {
    GTEST_SKIP() << "there is no fish";
  }
  EXPECT_EQ(
      run_in_shell("fish -c '" + kSpincat + " completion fish | source; complete -C \"spincat classify --vot\"'").out,
      "--votes\tShow what every judge said\n");
}

TEST(Completion, OfAnotherShellIsAnError) {
  const ShellResult result = run_in_shell(kSpincat + " completion tcsh 2>&1");
  EXPECT_EQ(result.code, 2);
  EXPECT_EQ(result.out, "spincat: there are no completions for 'tcsh' (bash, zsh or fish)\n");
}

}  // namespace
