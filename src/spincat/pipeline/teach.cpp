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

constexpr Eigen::Index kMostSharedProducts = 16'384 * 16'384;
constexpr std::uint64_t kCalibrationPurpose = 100;  // of derive_seed
constexpr std::uint64_t kCodebookPurpose = 102;

// Objects of the split, as indices into the table instead of into `objects`.
std::vector<std::uint32_t> picked(std::span<const std::uint32_t> objects, std::span<const std::uint32_t> indices) {
  std::vector<std::uint32_t> result;
  result.reserve(indices.size());
  for (const std::uint32_t i : indices) {
    result.push_back(objects[i]);
  }
  return result;
}

bool may_be_shared(Eigen::Index rows, Eigen::Index matrices) {
  return rows * rows <= kMostSharedProducts / matrices;
}

// Local features to learn a codebook from: the first ones of each row, as many from each, within a bound.
FeatureMatrix codebook_samples(const FeatureTable& table, std::span<const std::uint32_t> rows) {
  constexpr std::size_t kMostSamples = 16'384;
  const Eigen::Index size = table.local_size;
  const Eigen::Index each =
      std::clamp<Eigen::Index>(static_cast<Eigen::Index>(kMostSamples / rows.size()), 1, table.features.cols() / size);
  FeatureMatrix samples(static_cast<Eigen::Index>(rows.size()) * each, size);
  Eigen::Index next = 0;
  for (const std::uint32_t row : rows) {
    for (Eigen::Index i = 0; i < each; ++i) {
      samples.row(next++) = table.features.row(row).segment(i * size, size);
    }
  }
  return samples;
}

// What the codebook counts in the given rows; the other rows stay zero and are not looked at.
FeatureMatrix counted_rows(const FeatureTable& table, const Codebook& codebook, std::span<const std::uint32_t> rows,
                           int threads) {
  FeatureMatrix counted = FeatureMatrix::Zero(table.features.rows(), codebook.words.rows());
  for_each_index(rows.size(), threads, [&](std::size_t i) {
    const auto row = static_cast<Eigen::Index>(rows[i]);
    const std::span<const float> local(table.features.row(row).data(), static_cast<std::size_t>(table.features.cols()));
    std::ranges::copy(codebook.count(local), counted.row(row).data());
  });
  return counted;
}

// Teaches all judges on the given rows of `features`, which are the table's or were made from them.
JudgeList teach_all(const FeatureMatrix& features, std::span<const std::uint32_t> blocks, const SharedGram& gram,
                    const FeatureTable& table, std::span<const std::uint32_t> rows, const JudgeSettings& settings,
                    int threads, const Progress& progress) {
  const auto categories = static_cast<std::uint32_t>(table.categories.size());
  const std::vector<std::uint32_t> labels = table.row_labels();
  const TrainingSet training(features, gram, fit_kernel(settings.kernel, blocks, features, rows), labels, rows,
                             categories);
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
  return training.list(judges);
}

}  // namespace

SharedGram shared_gram(const FeatureTable& table, const JudgeSettings& settings, int threads) {
  const auto matrices = static_cast<Eigen::Index>(settings.kernel == KernelKind::linear ? 1 : table.blocks.size());
  const Eigen::Index rows = table.features.rows();
  if (table.local_size > 0 || !may_be_shared(rows, matrices)) {
    return {};
  }
  return make_shared_gram(settings.kernel, table.blocks, table.features, threads);
}

JudgeList teach_judges(const FeatureTable& table, const SharedGram& gram, std::span<const std::uint32_t> objects,
                       const JudgeSettings& settings, int threads, const Progress& progress) {
  const std::vector<std::uint32_t> rows = table.rows_of(objects);
  if (table.local_size == 0) {
    return teach_all(table.features, table.blocks, gram, table, rows, settings, threads, progress);
  }
  const std::uint64_t seed = derive_seed(table.seed, kCodebookPurpose);
  Codebook codebook = learn_codebook(codebook_samples(table, rows), table.words, seed, threads);
  const FeatureMatrix counted = counted_rows(table, codebook, rows, threads);
  const std::vector<std::uint32_t> blocks = {static_cast<std::uint32_t>(counted.cols())};
  // No shared products: each training has a codebook, and so features, of its own.
  const SharedGram own =
      may_be_shared(counted.rows(), 1) ? make_shared_gram(settings.kernel, blocks, counted, threads) : SharedGram{};
  JudgeList judges = teach_all(counted, blocks, own, table, rows, settings, threads, progress);
  judges.codebook = std::move(codebook);
  return judges;
}

Familiarity familiarity_of(const FeatureTable& table, std::span<const std::uint32_t> objects) {
  if (table.local_size > 0) {
    return {};  // local features are compared by the words of a codebook alone
  }
  const Eigen::Index length = table.features.cols() / table.parts;
  FeatureMatrix features(static_cast<Eigen::Index>(objects.size()), length);
  std::vector<std::uint32_t> labels;
  for (const std::uint32_t object : objects) {
    features.row(static_cast<Eigen::Index>(labels.size())) =
        table.features.row(static_cast<Eigen::Index>(object) * table.rows_per_object).head(length);
    labels.push_back(table.objects[object].category);
  }
  return make_familiarity(std::move(features), std::move(labels), static_cast<std::uint32_t>(table.categories.size()));
}

Calibration calibrate(const FeatureTable& table, const SharedGram& gram, std::span<const std::uint32_t> objects,
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
