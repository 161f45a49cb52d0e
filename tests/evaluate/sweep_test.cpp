#include "spincat/evaluate/sweep.h"

#include <fmt/ranges.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "spincat/files/file.h"
#include "support/expect_error.h"
#include "support/tiny_dataset.h"

namespace spincat {
namespace {

using test::input_error;
using test::TempDir;
using test::tiny_settings;
using Values = std::vector<std::string>;

const std::vector<Variation> kVariations = {{"spin_points", {"16", "32"}}, {"c", {"3", "300"}}};

// Rates by point, exactly.
std::vector<std::string> rates(const Sweep& sweep) {
  std::vector<std::string> lines;
  for (const SweepPoint& point : sweep.points) {
    lines.push_back(fmt::format("{} {} {} {} {}", fmt::join(point.values, " "), point.mean_class_rate.mean,
                                point.mean_class_rate.interval.low, point.overall_rate.mean,
                                point.overall_rate.deviation));
  }
  return lines;
}

// A line of a journal.
std::string checked(const std::string& text) {
  return fmt::format("{} {:08x}\n", text, crc32_z(0, reinterpret_cast<const Bytef*>(text.data()), text.size()));
}

class Sweeps : public testing::Test {
 protected:
  Sweeps() {
    test::write_tiny_shapes(dir_, "shapes", 4);
    options_.splits = 2;
  }

  Dataset shapes() const { return read_dataset({dir_ / "shapes"}); }
  Sweep swept(const std::filesystem::path& journal, const Progress& progress = {}) const {
    return sweep(shapes(), tiny_settings(), kVariations, options_, {.progress = progress}, journal);
  }

  TempDir dir_;
  EvaluateOptions options_;
};

TEST_F(Sweeps, EveryPointIsTheEvaluationWithItsSettings) {
  const Sweep found = swept({});
  ASSERT_EQ(found.points.size(), 4U);
  EXPECT_EQ(found.points[1].values, (Values{"16", "300"}));
  EXPECT_EQ(found.points[2].values, (Values{"32", "3"}));
  for (const SweepPoint& point : found.points) {
    Settings settings = tiny_settings();
    settings.prepare.spin_points = std::stoi(point.values[0]);
    settings.judge.c = std::stod(point.values[1]);
    const Evaluation alone = evaluate(shapes(), settings, options_);
    EXPECT_EQ(point.mean_class_rate.mean, alone.mean_class_rate.mean);
    EXPECT_EQ(point.overall_rate.deviation, alone.overall_rate.deviation);
  }
}

TEST_F(Sweeps, FeaturesAreDescribedOnceForAllSettingsOfTheJudges) {
  int described = 0;
  swept({}, [&](std::string_view stage, std::size_t done, std::size_t total) {
    described += stage == "describing objects" && done == total ? 1 : 0;
  });
  // Each object's copies report, too, so that a description may reach its total more than once; but never four times.
  EXPECT_EQ(described, 2);
}

TEST_F(Sweeps, AnInterruptedSweepGoesOnToTheSameResult) {
  struct Interrupted {};
  const auto journal = dir_ / "a.journal";
  const auto whole = dir_ / "b.journal";
  int judged = 0;
  EXPECT_THROW(swept(journal,
                     [&](std::string_view stage, std::size_t done, std::size_t total) {
                       if (stage == "judging splits" && done == total && ++judged == 3) {
                         throw Interrupted();
                       }
                     }),
               Interrupted);
  const std::string before = read_file(journal);
  EXPECT_EQ(std::ranges::count(before, '\n'), 3);  // which sweep, and two points
  {
    std::ofstream cut(journal, std::ios::app);
    cut << R"({"values":["32",)";  // the power fails
  }
  int described = 0;
  const Sweep resumed = swept(journal, [&](std::string_view stage, std::size_t done, std::size_t total) {
    described += stage == "describing objects" && done == total ? 1 : 0;
  });
  EXPECT_EQ(described, 1);
  EXPECT_EQ(rates(resumed), rates(swept(whole)));
  EXPECT_EQ(read_file(journal).substr(0, before.size()), before);
  EXPECT_EQ(std::ranges::count(read_file(journal), '\n'), 5);
  const std::string done = read_file(journal);
  const Progress never = [](std::string_view, std::size_t, std::size_t) { FAIL() << "nothing is left to do"; };
  EXPECT_EQ(rates(swept(journal, never)), rates(resumed));
  EXPECT_EQ(read_file(journal), done);
}

TEST_F(Sweeps, TheJournalOfAnotherSweepIsRefused) {
  const auto journal = dir_ / "a.journal";
  swept(journal);
  const std::string bytes = read_file(journal);
  const auto refusal = [&](const Settings& settings, const EvaluateOptions& options, const Dataset& dataset,
                           const std::vector<Variation>& variations, int threads = 1) {
    return input_error([&] { sweep(dataset, settings, variations, options, {.threads = threads}, journal); });
  };
  const std::string is = journal.string() + ": is the journal of another sweep (";
  Settings settings = tiny_settings();
  settings.copies = 2;
  EXPECT_EQ(refusal(settings, options_, shapes(), kVariations).rfind(is + "copies differs)", 0), 0U);
  EvaluateOptions options = options_;
  options.splits = 3;
  EXPECT_EQ(refusal(tiny_settings(), options, shapes(), kVariations).rfind(is + "splits differs)", 0), 0U);
  Dataset dataset = shapes();
  dataset.objects.pop_back();
  EXPECT_EQ(refusal(tiny_settings(), options_, dataset, kVariations).rfind(is + "data set differs)", 0), 0U);
  EXPECT_EQ(refusal(tiny_settings(), options_, shapes(), {{"c", {"3"}}}).rfind(is, 0), 0U);
  options = options_;
  EXPECT_EQ(refusal(tiny_settings(), options, shapes(), kVariations, 3), "no error");
  EXPECT_EQ(read_file(journal), bytes);
}

TEST_F(Sweeps, WhatIsNoJournalIsRefusedAndKept) {
  const auto notes = dir_.write("notes.txt", "dear diary\n");
  EXPECT_EQ(input_error([&] { swept(notes); }), notes.string() + ": is no journal of a sweep");
  EXPECT_EQ(read_file(notes), "dear diary\n");
  const auto unended = dir_.write("short.txt", "dear diary");
  EXPECT_EQ(input_error([&] { swept(unended); }), unended.string() + ": is no journal of a sweep");
  const auto foreign = dir_.write("foreign.json", R"({"sweep":"of the chimney"})");
  EXPECT_EQ(input_error([&] { swept(foreign); }), foreign.string() + ": is no journal of a sweep");
  EXPECT_EQ(read_file(foreign), R"({"sweep":"of the chimney"})");
}

TEST_F(Sweeps, ALineThatNoSweepWroteIsRefused) {
  const auto journal = dir_ / "s.journal";
  swept(journal);
  const std::string good = read_file(journal);
  const std::string next = std::to_string(std::ranges::count(good, '\n') + 1);
  dir_.write("s.journal", good + std::string(100'001, '[') + "\n");
  EXPECT_EQ(input_error([&] { swept(journal); }),
            journal.string() + ": line " + next + " is longer than any of a sweep");
  const std::string many = R"({"values":["1","2","3","4","5","6","7","8","9","10","11","12","13","14","15","16","17"],)"
                           R"("mean_class_rate":[1,1,1,1],"overall_rate":[1,1,1,1],"seconds":[1,1,1,1,1]})";
  for (const std::string& text : {many, std::string("[]"), std::string("{")}) {
    dir_.write("s.journal", good + checked(text));
    EXPECT_EQ(input_error([&] { swept(journal); }), journal.string() + ": line " + next + " is no point of a sweep");
  }
}

TEST_F(Sweeps, ADamagedLineIsRefused) {
  const auto journal = dir_ / "s.journal";
  swept(journal);
  const std::string good = read_file(journal);
  std::size_t line = 1;
  std::size_t digits = 0;
  for (std::size_t at = 0; at < good.size(); ++at) {
    if (good[at] >= '0' && good[at] <= '9') {
      std::string damaged = good;
      damaged[at] = good[at] == '9' ? '8' : static_cast<char>(good[at] + 1);
      dir_.write("s.journal", damaged);
      EXPECT_EQ(input_error([&] { swept(journal); }),
                fmt::format("{}: line {} is damaged (its checksum is not right): remove the file, or name another one",
                            journal.string(), line))
          << at;
      ++digits;
    }
    line += good[at] == '\n' ? 1 : 0;
  }
  EXPECT_GT(digits, 100U);
}

TEST_F(Sweeps, TheJournalOfAnOlderSpincatIsRefused) {
  const auto journal = dir_ / "s.journal";
  swept(journal);
  std::string older;
  std::istringstream lines(read_file(journal));
  for (std::string line; std::getline(lines, line);) {
    older += line.substr(0, line.size() - 9) + "\n";
  }
  dir_.write("s.journal", older);
  EXPECT_EQ(input_error([&] { swept(journal); }),
            journal.string() + ": is the journal of an older spincat: remove it, or name another file");
  EXPECT_EQ(read_file(journal), older);
}

TEST_F(Sweeps, ImpossibleSweepsAreRefusedBeforeAnyWork) {
  const Progress never = [](std::string_view, std::size_t, std::size_t) { FAIL() << "work before the refusal"; };
  const auto refusal = [&](const std::vector<Variation>& variations) {
    return input_error([&] { sweep(shapes(), tiny_settings(), variations, options_, {.progress = never}); });
  };
  EXPECT_EQ(refusal({}), "a sweep takes 1 to 10000 points, not 1");
  EXPECT_EQ(refusal({{"c", {"1"}}, {"judge.c", {"2"}}}), "setting 'judge.c' is varied twice");
  EXPECT_EQ(refusal({{"c", {"1", "1"}}}), "setting 'c' is to take one value twice");
  EXPECT_EQ(refusal({{"copies", {"1", "-1"}}}), "copies -1: expected 0 to 100");
  EXPECT_EQ(refusal({{"colour", {"1"}}}).rfind("setting 'colour' is not known (one of surface, ", 0), 0U);
}

}  // namespace
}  // namespace spincat
