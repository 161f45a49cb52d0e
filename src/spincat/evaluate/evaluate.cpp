#include "spincat/evaluate/evaluate.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

#include "spincat/dataset/parts.h"
#include "spincat/dataset/splits.h"
#include "spincat/describe/stopwatch.h"
#include "spincat/evaluate/evaluation_data.h"
#include "spincat/evaluate/roc.h"
#include "spincat/evaluate/trial.h"
#include "spincat/parallel/farm_execution.h"
#include "spincat/train/broadcast_table.h"
#include "spincat/train/judge_trainer.h"
#include "spincat/train/worth_broadcasting.h"

namespace spincat {
namespace {

std::vector<std::uint64_t> seeds_of(const EvaluateOptions& options, const Settings& settings) {
  return options.split_seeds.empty() ? std::vector{settings.seed} : options.split_seeds;
}

// One split for each object, in which it alone is tested; none for the only object of its category.
std::vector<Split> leave_one_out(const FeatureTable& table) {
  const std::vector<std::uint32_t> counts = table.object_counts();
  std::vector<Split> splits;
  for (std::uint32_t tested = 0; tested < table.objects.size(); ++tested) {
    if (counts[table.objects[tested].category] < 2) {
      continue;
    }
    Split split{{}, {tested}};
    for (std::uint32_t other = 0; other < table.objects.size(); ++other) {
      if (other != tested) {
        split.train.push_back(other);
      }
    }
    splits.push_back(std::move(split));
  }
  return splits;
}

Split everything_against(const FeatureTable& table, const TestTable& tested) {
  Split split{std::vector<std::uint32_t>(table.objects.size()), std::vector<std::uint32_t>(tested.objects.size())};
  std::iota(split.train.begin(), split.train.end(), 0U);
  std::iota(split.test.begin(), split.test.end(), 0U);
  return split;
}

// All splits, those of the first seed first.
std::vector<Split> splits_of(const EvaluationData& data, const Settings& settings, const EvaluateOptions& options) {
  std::vector<Split> splits;
  if (data.across) {
    splits = {everything_against(data.table, *data.tested)};
  } else if (options.leave_one_out) {
    splits = leave_one_out(data.table);
  } else {
    const std::vector<std::uint32_t> labels = data.table.object_labels();
    for (const std::uint64_t seed : seeds_of(options, settings)) {
      std::ranges::move(stratified_splits(labels, options.splits, options.test_share, seed),
                        std::back_inserter(splits));
    }
  }
  for (Split& split : splits) {  // what could not be described in the form it is tested in
    std::erase_if(split.test, [&](std::uint32_t i) { return data.tested && !data.tested->problems[i].empty(); });
  }
  return splits;
}

std::vector<Trial> run_trials(const EvaluationData& data, const std::vector<Split>& splits, const Settings& settings,
                              const EvaluateOptions& options, const Execution& execution, const BroadcastRows& rows) {
  const bool confidence = options.calibrates();
  const FarmExecution run(execution);
  const std::size_t trainings = count_trainings(splits.size(), confidence);
  const BroadcastTable broadcast(data.table, *run.farm, rows, trainings);
  JudgeTrainer trainer(broadcast, settings.judge, run.progress);
  std::vector<Trial> trials;
  if (splits.size() == 1) {  // its judges are the tasks
    trials.push_back(run_trial(trial_data(data), trainer, splits[0], settings, confidence));
    return trials;
  }
  Job job;
  job.kind = kTrialTasks;
  job.stays_here = !broadcast.is_broadcast();
  job.context = [&](Packer& packer) {
    pack_trials(trial_data(data), broadcast.ticket(trainer.gram()), settings, confidence, packer);
  };
  job.identity = [&](Packer& packer) { pack_trials_identity(trial_data(data), settings, confidence, packer); };
  job.work = trial_work(trial_data(data), trainer.gram(), settings, confidence);
  job.tasks = splits.size();
  job.task = [&](std::size_t i) { return pack(splits[i]); };
  job.deliver = [&](std::size_t, const std::string& result) { trials.push_back(unpack_trial(result)); };
  run.farm->run(job, run.ticking("judging splits", splits.size()));
  return trials;
}

void add(const Confusion& from, Confusion& to) {
  for (std::size_t i = 0; i < to.size(); ++i) {
    for (std::size_t j = 0; j < to.size(); ++j) {
      to[i][j] += from[i][j];
    }
  }
}

SeedRates rates_of(std::span<const Trial> trials, std::uint64_t seed, double test_share) {
  std::vector<double> class_rates;
  std::vector<double> overall_rates;
  for (const Trial& trial : trials) {
    class_rates.push_back(mean_class_rate(trial.confusion));
    overall_rates.push_back(overall_rate(trial.confusion));
  }
  return {seed, rate_over_splits(class_rates, test_share), rate_over_splits(overall_rates, test_share)};
}

// Of one category over the splits that tested it.
Rate category_rate(std::span<const Trial> trials, std::size_t category, double test_share) {
  std::vector<double> rates;
  for (const Trial& trial : trials) {
    const std::vector<std::uint32_t>& row = trial.confusion[category];
    if (const double all = std::accumulate(row.begin(), row.end(), 0.0); all > 0.0) {
      rates.push_back(row[category] / all);
    }
  }
  return rates.empty() ? Rate{} : rate_over_splits(rates, test_share);
}

// The confusion matrix as if each object had been tested once, with the same shares.
Confusion of_distinct_objects(const Evaluation& result) {
  Confusion confusion = result.confusion;
  for (std::size_t c = 0; c < confusion.size(); ++c) {
    const auto all = std::accumulate(confusion[c].begin(), confusion[c].end(), std::uint64_t{0});
    const std::uint64_t distinct = std::min<std::uint64_t>(all, result.object_counts[c]);
    const double share = all > 0 ? confusion[c][c] / static_cast<double>(all) : 0.0;
    const auto right = static_cast<std::uint32_t>(std::lround(share * static_cast<double>(distinct)));
    confusion[c].assign(confusion.size(), 0);
    confusion[c][c] = right;
    confusion[c][c == 0 ? confusion.size() - 1 : 0] += static_cast<std::uint32_t>(distinct) - right;
  }
  return confusion;
}

// Splits that all came out alike say nothing of how far their rate can be trusted; the number of objects does.
void widen(Rate& rate, const Interval& of_objects) {
  if (rate.interval.low == rate.interval.high) {
    rate.interval = of_objects;
  }
}

void widen_intervals(Evaluation& result) {
  const Confusion distinct = of_distinct_objects(result);
  widen(result.mean_class_rate, pooled_mean_class_rate(distinct).interval);
  widen(result.overall_rate, pooled_overall_rate(distinct).interval);
  for (std::size_t c = 0; c < distinct.size(); ++c) {
    const auto all = std::accumulate(distinct[c].begin(), distinct[c].end(), std::uint64_t{0});
    widen(result.category_rates[c], wilson_interval(distinct[c][c], all));
  }
}

void list_untested(Evaluation& result) {
  for (std::size_t c = 0; c < result.categories.size(); ++c) {
    if (std::ranges::all_of(result.confusion[c], [](std::uint32_t count) { return count == 0; })) {
      result.left_out.push_back({result.categories[c], "was never tested"});
    }
  }
}

void fill_rates(std::span<const Trial> trials, const EvaluateOptions& options, Evaluation& result) {
  if (result.protocol == Protocol::splits) {
    const auto each = static_cast<std::size_t>(result.splits);
    for (std::size_t s = 0; s < result.split_seeds.size(); ++s) {
      result.seeds.push_back(rates_of(trials.subspan(s * each, each), result.split_seeds[s], options.test_share));
    }
    const SeedRates all = rates_of(trials, 0, options.test_share);
    result.mean_class_rate = all.mean_class_rate;
    result.overall_rate = all.overall_rate;
    for (std::size_t c = 0; c < result.categories.size(); ++c) {
      result.category_rates.push_back(category_rate(trials, c, options.test_share));
    }
    widen_intervals(result);
    return;
  }
  result.mean_class_rate = pooled_mean_class_rate(result.confusion);
  result.overall_rate = pooled_overall_rate(result.confusion);
  for (std::size_t c = 0; c < result.categories.size(); ++c) {
    const std::vector<std::uint32_t>& row = result.confusion[c];
    const auto all = std::accumulate(row.begin(), row.end(), std::uint64_t{0});
    const double share = all > 0 ? static_cast<double>(row[c]) / static_cast<double>(all) : 0.0;
    result.category_rates.push_back({share, 0.0, wilson_interval(row[c], all)});
  }
}

// Rates by the number of views: the mean over splits; otherwise of everything together.
std::vector<ViewsRates> rates_by_views(std::span<const Trial> trials, std::uint32_t views, bool splits) {
  const std::vector<std::uint32_t> groups = view_counts(views);
  std::vector<ViewsRates> rates;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    std::vector<Confusion> parts;
    for (const Trial& trial : trials) {
      if (splits || parts.empty()) {
        parts.push_back(trial.by_views[g]);
      } else {
        add(trial.by_views[g], parts[0]);
      }
    }
    ViewsRates of{groups[g], 0.0, 0.0};
    for (const Confusion& part : parts) {
      of.mean_class_rate += mean_class_rate(part) / static_cast<double>(parts.size());
      of.overall_rate += overall_rate(part) / static_cast<double>(parts.size());
    }
    rates.push_back(of);
  }
  return rates;
}

double share_below(std::span<const double> values, double least) {
  const auto below = std::ranges::count_if(values, [&](double value) { return value < least; });
  return values.empty() ? 0.0 : static_cast<double>(below) / static_cast<double>(values.size());
}

ConfidenceMeasure measure_of(std::span<const Trial> trials) {
  ConfidenceMeasure measure;
  std::vector<double> right;
  std::vector<double> wrong;
  std::vector<double> unknown_objects;
  double known_or_unknown = 0.0;
  for (const Trial& trial : trials) {
    known_or_unknown += area_under_curve(trial.known, trial.unknown_objects);
    measure.turned_away += share_below(trial.known, trial.least_known) / static_cast<double>(trials.size());
    measure.strangers_turned_away +=
        share_below(trial.unknown_objects, trial.least_known) / static_cast<double>(trials.size());
    right.insert(right.end(), trial.right.begin(), trial.right.end());
    wrong.insert(wrong.end(), trial.wrong.begin(), trial.wrong.end());
    measure.unknown_objects = static_cast<std::uint32_t>(trial.unknown_objects.size());
  }
  measure.right_or_wrong = area_under_curve(right, wrong);
  measure.known_or_unknown = known_or_unknown / static_cast<double>(trials.size());
  const double sum =
      std::accumulate(right.begin(), right.end(), 0.0) + std::accumulate(wrong.begin(), wrong.end(), 0.0);
  measure.mean_confidence = sum / static_cast<double>(std::max<std::size_t>(1, right.size() + wrong.size()));
  return measure;
}

void list_problems(const TestTable& tested, std::vector<SkippedObject>& skipped) {
  for (std::size_t i = 0; i < tested.objects.size(); ++i) {
    if (!tested.problems[i].empty()) {
      skipped.push_back({tested.objects[i].file, tested.problems[i]});
    }
  }
}

std::vector<DatasetObject> described_objects(const TestTable& tested) {
  std::vector<DatasetObject> objects;
  for (std::size_t i = 0; i < tested.objects.size(); ++i) {
    if (tested.problems[i].empty()) {
      objects.push_back(tested.objects[i]);
    }
  }
  return objects;
}

// Of meshes that are tested by their views nothing is to be said.
std::string kind_mismatch_of(const EvaluationData& data, const Settings& settings) {
  if (!data.tested || settings.trained_for == TrainedFor::views) {
    return {};
  }
  for (const auto& [kind, count] : {std::pair(ObjectKind::mesh, data.tested->kinds.meshes),
                                    std::pair(ObjectKind::cloud, data.tested->kinds.clouds)}) {
    std::string reason = kind_mismatch(kind, data.table.kinds, settings.trained_for);
    if (count > 0 && !reason.empty()) {
      return reason;
    }
  }
  return {};
}

// What the objects are, before any of them is judged.
Evaluation facts_of(const EvaluationData& data, const EvaluateOptions& options) {
  Evaluation result;
  result.dataset = data.dataset;
  result.test_dataset = data.test_dataset;
  result.protocol = data.across ? Protocol::across : options.leave_one_out ? Protocol::leave_one_out : Protocol::splits;
  result.categories = data.table.categories;
  result.object_counts = data.table.object_counts();
  result.list_checksum = list_checksum(data.table.objects, data.table.categories);
  if (data.across) {
    const std::vector<DatasetObject> tested = described_objects(*data.tested);
    result.test_object_counts.assign(result.categories.size(), 0);
    for (const DatasetObject& object : tested) {
      ++result.test_object_counts[object.category];
    }
    result.test_list_checksum = list_checksum(tested, data.table.categories);
  }
  result.left_out = data.left_out;
  result.skipped = data.table.skipped;
  result.seconds = data.table.seconds;
  for (const TestTable* tested : {data.tested ? &*data.tested : nullptr, &data.unknown_objects}) {
    if (tested != nullptr) {
      list_problems(*tested, result.skipped);
      result.seconds += tested->seconds;
    }
  }
  std::ranges::stable_sort(result.skipped, {}, &SkippedObject::file);
  return result;
}

// Every object that can be tested, with the names that the trials gave it.
std::vector<TestedObject> named_objects(const EvaluationData& data, std::span<const Split> splits,
                                        std::span<const Trial> trials) {
  const std::vector<DatasetObject>& objects = data.tested ? data.tested->objects : data.table.objects;
  std::vector<TestedObject> named;
  for (const DatasetObject& object : objects) {
    named.push_back({object.file, object.category, {}});
  }
  for (std::size_t s = 0; s < splits.size(); ++s) {
    for (std::size_t i = 0; i < splits[s].test.size(); ++i) {
      named[splits[s].test[i]].named.push_back(trials[s].named[i]);
    }
  }
  std::size_t kept = 0;  // those that could not be described are listed as skipped
  for (std::size_t i = 0; i < named.size(); ++i) {
    if (!data.tested || data.tested->problems[i].empty()) {
      std::swap(named[kept++], named[i]);
    }
  }
  named.resize(kept);
  return named;
}

}  // namespace

Evaluation judge_evaluation(const EvaluationData& data, const Settings& settings, const EvaluateOptions& options,
                            const Execution& execution, const BroadcastRows& broadcast) {
  options.validate();
  Stopwatch watch;
  const std::vector<Split> splits = splits_of(data, settings, options);
  Evaluation result = facts_of(data, options);
  result.kind_mismatch = kind_mismatch_of(data, settings);
  result.splits = result.protocol == Protocol::splits ? options.splits : 1;
  if (result.protocol == Protocol::splits) {
    result.split_seeds = seeds_of(options, settings);
  }
  const std::vector<Trial> trials = run_trials(data, splits, settings, options, execution, broadcast);
  const std::size_t n = result.categories.size();
  result.confusion.assign(n, std::vector<std::uint32_t>(n, 0));
  for (const Trial& trial : trials) {
    add(trial.confusion, result.confusion);
  }
  result.tested = named_objects(data, splits, trials);
  fill_rates(trials, options, result);
  list_untested(result);
  result.views = rates_by_views(trials, data.table.tested_rows, result.protocol == Protocol::splits);
  if (options.calibrates()) {
    result.confidence = measure_of(trials);
  }
  const double judging = watch.lap();
  result.seconds.judge += judging;
  result.wall_seconds = data.wall_seconds + judging;
  return result;
}

Evaluation evaluate(const Dataset& dataset, const Settings& settings, const EvaluateOptions& options,
                    const Execution& execution) {
  BroadcastRows broadcast;
  const EvaluationData data = describe_for_evaluation(dataset, settings, options, execution, broadcast);
  return judge_evaluation(data, settings, options, execution, broadcast);
}

Evaluation evaluate_across(const Dataset& train, const Dataset& test, const Settings& settings,
                           const EvaluateOptions& options, const Execution& execution) {
  BroadcastRows broadcast;
  const EvaluationData data = describe_across(train, test, settings, options, execution, broadcast);
  return judge_evaluation(data, settings, options, execution, broadcast);
}

}  // namespace spincat
