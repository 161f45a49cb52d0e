// The first half of an evaluation: all objects to their features.
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <utility>

#include "spincat/dataset/parts.h"
#include "spincat/dataset/splits.h"
#include "spincat/describe/stopwatch.h"
#include "spincat/error.h"
#include "spincat/evaluate/evaluate.h"
#include "spincat/evaluate/evaluation_data.h"
#include "spincat/train/describe_dataset.h"
#include "spincat/train/worth_broadcasting.h"

namespace spincat {
namespace {

// Up to here each split learns its directions from its own training objects alone. Above, they are those of a sample of
// all objects, without their categories; what is learned from categories is learned from training objects always.
constexpr std::size_t kMostWholeRows = 16'384;

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
                              const EvaluateOptions& options, const Execution& execution, BroadcastRows& broadcast) {
  EvaluationData data;
  data.dataset = dataset.name;
  // Strangers are told where confidence is measured, and nowhere else.
  Dataset learned = dataset;
  Settings learning = settings;
  if (!options.calibrates()) {
    learned.others.clear();
    learning.background = 0;
  }
  data.table = describe_dataset(learned, learning, execution, count_trainings(splits, options.calibrates()),
                                kMostWholeRows, broadcast);
  data.basis =
      std::exchange(data.table.basis, {});  // judges are to see coordinates, as what is tested is described by them
  std::vector<DatasetObject> unknown_objects;
  for (const std::filesystem::path& file : options.unknown_objects) {
    if (std::ranges::find(dataset.others, file) != dataset.others.end()) {
      throw InputError(file.string(), "is among the others to learn from and among the unknown objects to test with");
    }
    unknown_objects.push_back({file, 0, ""});
  }
  // As they are: whether a stranger is turned or sampled, it stays a stranger.
  data.unknown_objects =
      describe_tested(unknown_objects, data.basis, data.table.features.cols(), settings, TestOptions{}, execution);
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
                                       const Execution& execution, BroadcastRows& broadcast) {
  options.validate();
  check_form(settings, options);
  Stopwatch watch;
  std::vector<LeftOutCategory> left_out;
  const Dataset part = with_enough_objects(dataset, options.fewest_objects, left_out);
  EvaluationData data =
      describe_known(part, splits_in_sight(options, part.objects.size()), settings, options, execution, broadcast);
  data.left_out = std::move(left_out);
  if (options.test.form != TestForm::as_is) {
    data.tested =
        describe_tested(data.table.objects, data.basis, data.table.features.cols(), settings, options.test, execution);
  }
  data.wall_seconds = watch.lap();
  return data;
}

EvaluationData describe_across(const Dataset& train, const Dataset& test, const Settings& settings,
                               const EvaluateOptions& options, const Execution& execution, BroadcastRows& broadcast) {
  options.validate();
  check_form(settings, options);
  Stopwatch watch;
  std::vector<LeftOutCategory> left_out;
  const auto [learned, tested] =
      common_categories(with_enough_objects(train, options.fewest_objects, left_out), test, left_out);
  if (execution.strict && !tested.skipped.empty()) {
    throw InputError(tested.skipped.front().file.string(), tested.skipped.front().reason);
  }
  EvaluationData data = describe_known(learned, 1, settings, options, execution, broadcast);
  data.test_dataset = tested.name;
  data.across = true;
  data.left_out = std::move(left_out);
  data.tested =
      describe_tested(tested.objects, data.basis, data.table.features.cols(), settings, options.test, execution);
  if (learned.name != tested.name) {  // else they are the same
    data.table.skipped.insert(data.table.skipped.end(), tested.skipped.begin(), tested.skipped.end());
  }
  data.wall_seconds = watch.lap();
  return data;
}

}  // namespace spincat
