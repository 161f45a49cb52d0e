// The first half of an evaluation: all objects to their features.
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <utility>

#include "spincat/dataset/splits.h"
#include "spincat/describe/stopwatch.h"
#include "spincat/error.h"
#include "spincat/evaluate/evaluate.h"
#include "spincat/parallel/task_farm.h"
#include "spincat/train/worth_broadcasting.h"

namespace spincat {
namespace {

void check_all_described(const TestTable& tested) {
  for (std::size_t i = 0; i < tested.objects.size(); ++i) {
    if (!tested.problems[i].empty()) {
      throw InputError(tested.objects[i].file.string(), tested.problems[i]);
    }
  }
}

TestTable described(std::span<const DatasetObject> objects, const EvaluationData& data, const Settings& settings,
                    const TestOptions& test, const EvaluateOptions& options, const Progress& progress) {
  LocalFarm own(options.threads);
  TaskFarm& farm = options.farm != nullptr ? *options.farm : own.farm();
  TestTable tested =
      describe_tested(objects, static_cast<std::size_t>(data.table.features.cols()), settings, test, farm, progress);
  if (options.strict) {
    check_all_described(tested);
  }
  return tested;
}

// Views are made of the objects as they are.
void check_form(const Settings& settings, const EvaluateOptions& options) {
  if (settings.trained_for == TrainedFor::views && options.test.form != TestForm::as_is) {
    throw InputError("judges trained by views are tested on views: no other form of the tested objects is possible");
  }
}

// How many splits there will be, where all objects can be read.
std::size_t splits_in_sight(const EvaluateOptions& options, std::size_t objects) {
  if (options.leave_one_out) {
    return objects;
  }
  return static_cast<std::size_t>(options.splits) * std::max<std::size_t>(1, options.split_seeds.size());
}

// What both kinds have in common: the objects to learn from, and the unknown objects.
EvaluationData describe_known(const Dataset& dataset, std::size_t splits, const Settings& settings,
                              const EvaluateOptions& options, const Progress& progress) {
  EvaluationData data;
  data.dataset = dataset.name;
  LocalFarm own(options.threads);
  TaskFarm& farm = options.farm != nullptr ? *options.farm : own.farm();
  data.table = describe_dataset(dataset, settings, options.strict, farm, options.division,
                                count_trainings(splits, options.calibrates()), progress);
  std::vector<DatasetObject> unknown_objects;
  for (const std::filesystem::path& file : options.unknown_objects) {
    unknown_objects.push_back({file, 0, ""});
  }
  // As they are: whether a stranger is turned or sampled, it stays a stranger.
  TestOptions as_they_are;
  as_they_are.limits = options.test.limits;
  data.unknown_objects = described(unknown_objects, data, settings, as_they_are, options, progress);
  return data;
}

}  // namespace

void EvaluateOptions::validate() const {
  check_splits(splits, test_share);
  if (fewest_objects < 1 || fewest_objects > 1'000'000) {
    throw InputError(fmt::format("fewest objects {} is out of range (1 to 1000000)", fewest_objects));
  }
  test.validate();
}

EvaluationData describe_for_evaluation(const Dataset& dataset, const Settings& settings, const EvaluateOptions& options,
                                       const Progress& progress) {
  options.validate();
  check_form(settings, options);
  Stopwatch watch;
  std::vector<LeftOutCategory> left_out;
  const Dataset part = with_enough_objects(dataset, options.fewest_objects, left_out);
  EvaluationData data =
      describe_known(part, splits_in_sight(options, part.objects.size()), settings, options, progress);
  data.left_out = std::move(left_out);
  if (options.test.form != TestForm::as_is) {
    data.tested = described(data.table.objects, data, settings, options.test, options, progress);
  }
  data.wall_seconds = watch.lap();
  return data;
}

EvaluationData describe_across(const Dataset& train, const Dataset& test, const Settings& settings,
                               const EvaluateOptions& options, const Progress& progress) {
  options.validate();
  check_form(settings, options);
  Stopwatch watch;
  std::vector<LeftOutCategory> left_out;
  const auto [learned, tested] =
      common_categories(with_enough_objects(train, options.fewest_objects, left_out), test, left_out);
  if (options.strict && !tested.skipped.empty()) {
    throw InputError(tested.skipped.front().file.string(), tested.skipped.front().reason);
  }
  EvaluationData data = describe_known(learned, 1, settings, options, progress);
  data.test_dataset = tested.name;
  data.across = true;
  data.left_out = std::move(left_out);
  data.tested = described(tested.objects, data, settings, options.test, options, progress);
  if (learned.name != tested.name) {  // else they are the same
    data.table.skipped.insert(data.table.skipped.end(), tested.skipped.begin(), tested.skipped.end());
  }
  data.wall_seconds = watch.lap();
  return data;
}

}  // namespace spincat
