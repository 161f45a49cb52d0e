#include "spincat/pipeline/teach.h"

#include <algorithm>
#include <cstddef>
#include <mutex>
#include <utility>
#include <vector>

#include "spincat/dataset/splits.h"
#include "spincat/geometry/random.h"
#include "spincat/parallel/for_each.h"

namespace spincat {
namespace {

constexpr Eigen::Index kMostSharedRows = 16'384;
constexpr std::uint64_t kCalibrationPurpose = 100;  // of derive_seed

// Objects of the split, as indices into the table instead of into `objects`.
std::vector<std::uint32_t> picked(std::span<const std::uint32_t> objects, std::span<const std::uint32_t> indices) {
  std::vector<std::uint32_t> result;
  result.reserve(indices.size());
  for (const std::uint32_t i : indices) {
    result.push_back(objects[i]);
  }
  return result;
}

}  // namespace

Eigen::MatrixXf shared_gram(const FeatureTable& table, int threads) {
  if (table.features.rows() > kMostSharedRows) {
    return {};
  }
  return gram_matrix(table.features, threads);
}

JudgeList teach_judges(const FeatureTable& table, const Eigen::MatrixXf& gram, std::span<const std::uint32_t> objects,
                       const JudgeSettings& settings, int threads, const Progress& progress) {
  const auto categories = static_cast<std::uint32_t>(table.categories.size());
  const std::vector<std::uint32_t> labels = table.row_labels();
  const std::vector<std::uint32_t> rows = table.rows_of(objects);
  const TrainingSet training(table.features, gram, labels, rows, categories);
  const std::vector<CategoryPair> pairs = all_pairs(categories);
  std::vector<Judge> judges(pairs.size());
  std::mutex mutex;
  std::size_t done = 0;
  for_each_index(pairs.size(), threads, [&](std::size_t l) {
    judges[l] = training.teach(pairs[l], settings);
    const std::lock_guard lock(mutex);
    ++done;
    if (progress) {
      progress("teaching judges", done, pairs.size());
    }
  });
  return JudgeList::fold(categories, judges);
}

Familiarity familiarity_of(const FeatureTable& table, std::span<const std::uint32_t> objects) {
  FeatureMatrix features(static_cast<Eigen::Index>(objects.size()), table.features.cols());
  std::vector<std::uint32_t> labels;
  for (const std::uint32_t object : objects) {
    features.row(static_cast<Eigen::Index>(labels.size())) =
        table.features.row(static_cast<Eigen::Index>(object) * table.rows_per_object);
    labels.push_back(table.objects[object].category);
  }
  return make_familiarity(std::move(features), std::move(labels), static_cast<std::uint32_t>(table.categories.size()));
}

Calibration calibrate(const FeatureTable& table, const Eigen::MatrixXf& gram, std::span<const std::uint32_t> objects,
                      const JudgeSettings& settings, std::uint64_t seed, int threads, const Progress& progress) {
  constexpr int kFolds = 5;
  if (objects.size() < static_cast<std::size_t>(kFolds)) {
    return {};
  }
  std::vector<std::uint32_t> labels;
  std::vector<std::size_t> in_category(table.categories.size(), 0);
  for (const std::uint32_t object : objects) {
    labels.push_back(table.objects[object].category);
    ++in_category[labels.back()];
  }
  std::vector<JudgedObject> votes;
  std::vector<JudgedObject> strangers;
  for (Split& fold : stratified_folds(labels, kFolds, derive_seed(seed, kCalibrationPurpose))) {
    std::vector<std::uint32_t> judged;
    for (const std::uint32_t i : fold.test) {
      (in_category[labels[i]] > 1 ? judged : fold.train).push_back(i);
    }
    std::ranges::sort(fold.train);
    const std::vector<std::uint32_t> taught = picked(objects, fold.train);
    const JudgeList judges = teach_judges(table, gram, taught, settings, threads, Progress{});
    const Familiarity familiarity = familiarity_of(table, taught);
    for (const std::uint32_t i : judged) {
      const std::span<const float> features = table.features_of(objects[i]);
      const Ballot ballot = judges.vote(features);
      votes.push_back({ballot.weakest_margin, ballot.winner == labels[i], familiarity.of(features, ballot.winner)});
      if (table.categories.size() > 2) {
        const Ballot as_stranger = ballot_without(ballot, labels[i]);
        strangers.push_back({as_stranger.weakest_margin, false, familiarity.of(features, as_stranger.winner)});
      }
    }
    if (progress) {
      progress("calibrating", votes.size(), objects.size());
    }
  }
  return fit_calibration(votes, strangers);
}

}  // namespace spincat
