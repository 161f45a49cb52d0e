#include "spincat/pipeline/teach.h"

#include <algorithm>
#include <cstddef>
#include <mutex>
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
  for (Split& fold : stratified_folds(labels, kFolds, derive_seed(seed, kCalibrationPurpose))) {
    std::vector<std::uint32_t> judged;
    for (const std::uint32_t i : fold.test) {
      (in_category[labels[i]] > 1 ? judged : fold.train).push_back(i);
    }
    std::ranges::sort(fold.train);
    const JudgeList judges = teach_judges(table, gram, picked(objects, fold.train), settings, threads, Progress{});
    for (const std::uint32_t i : judged) {
      const Ballot ballot = judges.vote(table.features_of(objects[i]));
      votes.push_back({ballot.weakest_margin, ballot.winner == labels[i]});
    }
    if (progress) {
      progress("calibrating", votes.size(), objects.size());
    }
  }
  return fit_calibration(votes);
}

}  // namespace spincat
