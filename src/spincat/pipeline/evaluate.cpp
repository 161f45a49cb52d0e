#include "spincat/pipeline/evaluate.h"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <numeric>

#include "spincat/dataset/splits.h"
#include "spincat/error.h"
#include "spincat/pipeline/feature_table.h"
#include "spincat/pipeline/stopwatch.h"
#include "spincat/pipeline/teach.h"

namespace spincat {
namespace {

using Confusion = std::vector<std::vector<std::uint32_t>>;

void check(const EvaluateOptions& options) {
  if (options.splits < 1 || options.splits > 10'000) {
    throw InputError(fmt::format("number of splits {} is out of range (1 to 10000)", options.splits));
  }
  if (!(options.test_fraction > 0.0 && options.test_fraction < 1.0)) {
    throw InputError(fmt::format("test fraction {} is out of range (between 0 and 1)", options.test_fraction));
  }
}

Confusion judge_split(const FeatureTable& table, const Eigen::MatrixXf& gram, const Split& split,
                      const JudgeSettings& settings, int threads) {
  const std::size_t n = table.categories.size();
  const JudgeList judges = teach_judges(table, gram, split.train, settings, threads, Progress{});
  Confusion confusion(n, std::vector<std::uint32_t>(n, 0));
  for (const std::uint32_t object : split.test) {
    const Ballot ballot = judges.vote(table.features_of(object));
    ++confusion[table.objects[object].category][ballot.winner];
  }
  return confusion;
}

// The mean over the categories that were tested of the share of their objects that were named right.
double mean_class_rate(const Confusion& confusion) {
  double sum = 0.0;
  int tested = 0;
  for (std::size_t truth = 0; truth < confusion.size(); ++truth) {
    const auto all = std::accumulate(confusion[truth].begin(), confusion[truth].end(), 0.0);
    if (all > 0.0) {
      sum += confusion[truth][truth] / all;
      ++tested;
    }
  }
  return tested > 0 ? sum / tested : 0.0;
}

double overall_rate(const Confusion& confusion) {
  double right = 0.0;
  double all = 0.0;
  for (std::size_t truth = 0; truth < confusion.size(); ++truth) {
    right += confusion[truth][truth];
    all = std::accumulate(confusion[truth].begin(), confusion[truth].end(), all);
  }
  return all > 0.0 ? right / all : 0.0;
}

Rate rate_over(const std::vector<double>& values) {
  const auto n = static_cast<double>(values.size());
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
  double squares = 0.0;
  for (const double v : values) {
    squares += (v - mean) * (v - mean);
  }
  return {mean, n > 1.0 ? std::sqrt(squares / (n - 1.0)) : 0.0};
}

void add(const Confusion& from, Confusion& to) {
  for (std::size_t i = 0; i < to.size(); ++i) {
    for (std::size_t j = 0; j < to.size(); ++j) {
      to[i][j] += from[i][j];
    }
  }
}

}  // namespace

Evaluation evaluate(const Dataset& dataset, const Settings& settings, const EvaluateOptions& options,
                    const Progress& progress) {
  check(options);
  Stopwatch whole;
  const FeatureTable table = describe_dataset(dataset, settings, options.strict, options.threads, progress);
  const std::vector<std::uint32_t> labels = table.object_labels();
  const std::vector<Split> splits = stratified_splits(labels, options.splits, options.test_fraction, settings.seed);

  Stopwatch watch;
  const Eigen::MatrixXf gram = shared_gram(table, options.threads);
  const std::size_t n = table.categories.size();
  Evaluation result;
  result.confusion.assign(n, std::vector<std::uint32_t>(n, 0));
  std::vector<double> class_rates;
  std::vector<double> overall_rates;
  for (const Split& split : splits) {
    const Confusion confusion = judge_split(table, gram, split, settings.judge, options.threads);
    class_rates.push_back(mean_class_rate(confusion));
    overall_rates.push_back(overall_rate(confusion));
    add(confusion, result.confusion);
    if (progress) {
      progress("judging splits", class_rates.size(), splits.size());
    }
  }

  result.dataset = dataset.name;
  result.categories = table.categories;
  result.object_counts = table.object_counts();
  result.skipped = table.skipped;
  result.splits = options.splits;
  result.mean_class_rate = rate_over(class_rates);
  result.overall_rate = rate_over(overall_rates);
  result.seconds = table.seconds;
  result.seconds.judge += watch.lap();
  result.wall_seconds = whole.lap();
  return result;
}

}  // namespace spincat
