// The protocols of evaluate; what they have in common is in train_test.cpp.
#include "spincat/evaluate/evaluate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <variant>

#include "spincat/dataset/parts.h"
#include "spincat/error.h"
#include "spincat/evaluate/evaluation_data.h"
#include "spincat/evaluate/tested_objects.h"
#include "spincat/parallel/journal.h"
#include "spincat/parallel/task_farm.h"
#include "support/expect_error.h"
#include "support/tiny_dataset.h"

namespace spincat {
namespace {

using test::input_error;
using test::TempDir;
using test::tiny_settings;
using Names = std::vector<std::string>;

class Protocols : public testing::Test {
 protected:
  Protocols() { test::write_tiny_shapes(dir_, "shapes", 4); }

  Dataset shapes() const { return read_dataset({dir_ / "shapes"}); }

  TempDir dir_;
};

std::uint32_t all_of(const std::vector<std::uint32_t>& row) {
  return std::accumulate(row.begin(), row.end(), 0U);
}

TEST_F(Protocols, LeaveOneOutTestsEachObjectOnce) {
  EvaluateOptions options;
  options.leave_one_out = true;
  const Evaluation one = evaluate(shapes(), tiny_settings(), options);
  const Evaluation three = evaluate(shapes(), tiny_settings(), options, {.threads = 3});
  EXPECT_EQ(one.protocol, Protocol::leave_one_out);
  EXPECT_EQ(one.confusion, three.confusion);
  ASSERT_EQ(one.confusion.size(), 3U);
  for (const auto& row : one.confusion) {
    EXPECT_EQ(all_of(row), 4U);
  }
  EXPECT_EQ(one.confusion, (Confusion{{4, 0, 0}, {0, 4, 0}, {0, 0, 4}}));  // three shapes that nobody mistakes
  EXPECT_EQ(one.mean_class_rate.mean, 1.0);
  EXPECT_EQ(one.overall_rate.interval.low, wilson_interval(12, 12).low);
  EXPECT_EQ(one.category_rates[1].interval.low, wilson_interval(4, 4).low);
  EXPECT_TRUE(one.seeds.empty());
}

TEST_F(Protocols, TellWhatEachObjectWasNamed) {
  EvaluateOptions options;
  options.splits = 5;
  options.split_seeds = {1, 2};
  const Evaluation found = evaluate(shapes(), tiny_settings(), options);
  ASSERT_EQ(found.tested.size(), 12U);
  Confusion counted(3, std::vector<std::uint32_t>(3, 0));
  std::size_t names = 0;
  for (std::size_t i = 0; i < found.tested.size(); ++i) {
    const TestedObject& object = found.tested[i];
    EXPECT_EQ(object.file, shapes().objects[i].file);
    EXPECT_EQ(object.category, shapes().objects[i].category);
    for (const std::uint32_t name : object.named) {
      ++counted[object.category][name];
      ++names;
    }
  }
  EXPECT_EQ(names, 30U);  // one of each of three categories in each of ten splits
  EXPECT_EQ(counted, found.confusion);
}

TEST_F(Protocols, LeaveOneOutCannotTestTheOnlyObjectOfItsCategory) {
  Dataset dataset = shapes();
  bool kept = false;
  std::erase_if(dataset.objects, [&](const auto& object) { return object.category == 1 && std::exchange(kept, true); });
  EvaluateOptions options;
  options.leave_one_out = true;
  const Evaluation found = evaluate(dataset, tiny_settings(), options);
  EXPECT_EQ(found.object_counts, (std::vector<std::uint32_t>{4, 1, 4}));
  EXPECT_EQ(all_of(found.confusion[1]), 0U);
  EXPECT_EQ(all_of(found.confusion[0]) + all_of(found.confusion[2]), 8U);
  ASSERT_EQ(found.left_out.size(), 1U);
  EXPECT_EQ(found.left_out[0].name, "cone");
  EXPECT_EQ(found.left_out[0].reason, "was never tested");
}

TEST_F(Protocols, SplitsThatAllCameOutAlikeAreNoCertainty) {
  EvaluateOptions options;
  options.splits = 4;
  options.split_seeds = {3};
  Evaluation found = evaluate(shapes(), tiny_settings(), options);
  for (const Rate& rate : found.category_rates) {
    EXPECT_LT(rate.interval.low, rate.interval.high);
    if (rate.mean == 1.0 && rate.deviation == 0.0) {  // four objects of each
      EXPECT_EQ(rate.interval.low, wilson_interval(4, 4).low);
    }
  }
  EXPECT_LT(found.mean_class_rate.interval.low, found.mean_class_rate.interval.high);
  EXPECT_LT(found.overall_rate.interval.low, found.overall_rate.interval.high);
}

TEST_F(Protocols, SeveralSeedsAreTheMeanOfEach) {
  EvaluateOptions options;
  options.splits = 2;
  options.split_seeds = {3, 7, 9};
  const Evaluation all = evaluate(shapes(), tiny_settings(), options);
  EXPECT_EQ(all.splits, 2);
  ASSERT_EQ(all.seeds.size(), 3U);
  Confusion sum(3, std::vector<std::uint32_t>(3, 0));
  double mean = 0.0;
  for (std::size_t s = 0; s < 3; ++s) {
    options.split_seeds = {all.seeds[s].seed};
    const Evaluation one = evaluate(shapes(), tiny_settings(), options);
    EXPECT_EQ(all.seeds[s].mean_class_rate.mean, one.mean_class_rate.mean);
    EXPECT_EQ(all.seeds[s].overall_rate.deviation, one.overall_rate.deviation);
    mean += one.mean_class_rate.mean / 3.0;
    for (std::size_t i = 0; i < 9; ++i) {
      sum[i / 3][i % 3] += one.confusion[i / 3][i % 3];
    }
  }
  EXPECT_EQ(all.confusion, sum);
  EXPECT_NEAR(all.mean_class_rate.mean, mean, 1e-12);
}

TEST_F(Protocols, SplitsFollowTheSeedUnlessTheyHaveTheirOwn) {
  EvaluateOptions options;
  options.splits = 3;
  EXPECT_EQ(evaluate(shapes(), tiny_settings(), options).split_seeds, std::vector<std::uint64_t>{1});
  Settings settings = tiny_settings();
  settings.seed = 5;
  EXPECT_EQ(evaluate(shapes(), settings, options).split_seeds, std::vector<std::uint64_t>{5});
  options.split_seeds = {1};
  EXPECT_EQ(evaluate(shapes(), settings, options).split_seeds, std::vector<std::uint64_t>{1});
}

TEST_F(Protocols, SmallCategoriesAreLeftOut) {
  dir_.write("shapes/tube/0.off", test::off_text(test::cylinder(16, 1, 1, 1)));
  dir_.write("shapes/tube/1.off", test::off_text(test::cylinder(16, 1, 1, 2)));
  EvaluateOptions options;
  options.splits = 1;
  options.fewest_objects = 3;
  const Evaluation found = evaluate(shapes(), tiny_settings(), options);
  EXPECT_EQ(found.categories, (Names{"box", "cone", "spindle"}));
  ASSERT_EQ(found.left_out.size(), 1U);
  EXPECT_EQ(found.left_out[0].name, "tube");
  options.fewest_objects = 5;
  EXPECT_EQ(input_error([&] { evaluate(shapes(), tiny_settings(), options); }),
            (dir_ / "shapes").string() + ": two or more categories are needed to learn from");
}

TEST_F(Protocols, AcrossTestsEveryObjectOfTheOtherDataSetOnce) {
  test::write_tiny_shapes(dir_, "others", 2, 4);
  dir_.write("others/tube/0.off", test::off_text(test::cylinder(16, 1, 1, 1)));
  std::filesystem::remove_all(dir_ / "others/cone");
  const Dataset others = read_dataset({dir_ / "others"});
  const Evaluation found = evaluate_across(shapes(), others, tiny_settings(), {});
  EXPECT_EQ(found.protocol, Protocol::across);
  EXPECT_EQ(found.categories, (Names{"box", "spindle"}));
  EXPECT_EQ(found.object_counts, (std::vector<std::uint32_t>{4, 4}));
  EXPECT_EQ(found.test_object_counts, (std::vector<std::uint32_t>{2, 2}));
  EXPECT_EQ(found.confusion, (Confusion{{2, 0}, {0, 2}}));
  EXPECT_EQ(found.test_dataset, others.name);
  EXPECT_NE(found.list_checksum, found.test_list_checksum);
  ASSERT_EQ(found.left_out.size(), 2U);
  EXPECT_EQ(found.left_out[0].name, "cone");
  EXPECT_EQ(found.left_out[1].name, "tube");
}

TEST_F(Protocols, AcrossDoesNotDependOnThreadsAndSkipsWhatCannotBeRead) {
  test::write_tiny_shapes(dir_, "others", 2, 4);
  const auto broken = dir_.write("others/box/broken.off", "OFF 1 0 0\n");
  const Dataset others = read_dataset({dir_ / "others"});
  EvaluateOptions options;
  const Evaluation one = evaluate_across(shapes(), others, tiny_settings(), options);
  const Evaluation three = evaluate_across(shapes(), others, tiny_settings(), options, {.threads = 3});
  EXPECT_EQ(one.confusion, three.confusion);
  EXPECT_EQ(one.test_object_counts, (std::vector<std::uint32_t>{2, 2, 2}));
  ASSERT_EQ(one.skipped.size(), 1U);
  EXPECT_EQ(one.skipped[0].file, broken);
  EXPECT_EQ(input_error([&] {
              evaluate_across(shapes(), others, tiny_settings(), options, {.threads = 3, .strict = true});
            }).rfind(broken.string() + ": ", 0),
            0U);
}

TEST_F(Protocols, TheOfficialSplitIsRespected) {
  // A box among the cones of the test part: named rightly, it is an error of the data set's labels and counts as such.
  test::write_tiny_shapes(dir_, "both/train", 3);
  test::write_tiny_shapes(dir_, "both/test", 2, 4);
  dir_.write("both/test/cone/box.off", test::off_text(test::tiny_shape("box", 6)));
  const Dataset both = read_dataset({dir_ / "both"});
  const Evaluation found = evaluate_across(training_part(both), testing_part(both), tiny_settings(), {});
  EXPECT_EQ(found.object_counts, (std::vector<std::uint32_t>{3, 3, 3}));
  EXPECT_EQ(found.confusion, (Confusion{{2, 0, 0}, {1, 2, 0}, {0, 0, 2}}));
  EXPECT_NEAR(found.mean_class_rate.mean, (1.0 + 2.0 / 3.0 + 1.0) / 3.0, 1e-12);
}

TEST_F(Protocols, TurnedAndSampledObjectsAreNamedAsTheirMeshes) {
  EvaluateOptions options;
  options.splits = 2;
  for (const TestForm form : {TestForm::turned, TestForm::cloud}) {
    options.test.form = form;
    options.test.noise = 0.001;
    const Evaluation found = evaluate(shapes(), tiny_settings(), options);
    EXPECT_EQ(all_of(found.confusion[0]), 2U);
    EXPECT_GE(found.mean_class_rate.mean, 0.5) << static_cast<int>(form);
  }
}

TEST_F(Protocols, ConfidenceIsMeasuredOnKnownAndUnknownObjects) {
  EvaluateOptions options;
  options.splits = 2;
  EXPECT_FALSE(evaluate(shapes(), tiny_settings(), options).confidence.has_value());
  options.unknown_objects = {dir_.write("ball.off", test::off_text(test::icosphere(2))), dir_ / "absent.off"};
  const Evaluation one = evaluate(shapes(), tiny_settings(), options);
  const Evaluation three = evaluate(shapes(), tiny_settings(), options, {.threads = 3});
  ASSERT_TRUE(one.confidence && three.confidence);
  EXPECT_EQ(one.confidence->unknown_objects, 1U);
  EXPECT_EQ(one.confidence->known_or_unknown, three.confidence->known_or_unknown);
  EXPECT_EQ(one.confidence->mean_confidence, three.confidence->mean_confidence);
  EXPECT_GT(one.confidence->mean_confidence, 0.0);
  EXPECT_LT(one.confidence->mean_confidence, 1.0);
  ASSERT_EQ(one.skipped.size(), 1U);
  EXPECT_EQ(one.skipped[0].file, dir_ / "absent.off");
}

// An interrupted evaluation goes on after the splits that are judged.
TEST_F(Protocols, AJournalKeepsSplitsForTheSameDataAndSettings) {
  EvaluateOptions options;
  options.splits = 6;
  Settings settings = tiny_settings();
  BroadcastRows rows;
  EvaluationData data = describe_for_evaluation(shapes(), settings, options, {}, rows);
  const Evaluation expected = judge_evaluation(data, settings, options, {}, rows);
  Journal journal(dir_ / "j", {"settings", "data"});
  Evaluation found;
  const auto resumed = [&](const Progress& progress = {}) {
    LocalFarm own(2);
    own.farm().use_journal(&journal);
    found = judge_evaluation(data, settings, options, {.farm = &own.farm(), .progress = progress}, {});
    return own.farm().report().resumed;
  };
  const Progress stop = [](std::string_view stage, std::size_t done, std::size_t) {
    if (stage == "judging splits" && done >= 3) {
      throw RunError("killed");
    }
  };
  EXPECT_THROW(resumed(stop), RunError);
  const std::size_t judged = journal.size();
  EXPECT_GE(judged, 3U);
  EXPECT_EQ(resumed(), judged);
  EXPECT_EQ(found.confusion, expected.confusion);
  EXPECT_EQ(resumed(), 6U);
  EXPECT_EQ(found.confusion, expected.confusion);
  settings.judge.c *= 2.0;
  EXPECT_EQ(resumed(), 0U);
  data.table.features(0, 0) += 1.0F;
  EXPECT_EQ(resumed(), 0U);
  options.splits = 5;
  EXPECT_EQ(resumed(), 0U);
}

}  // namespace
}  // namespace spincat
