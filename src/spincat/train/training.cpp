#include "spincat/train/training.h"

#include <algorithm>
#include <cstddef>

#include "spincat/geometry/random.h"

namespace spincat {
namespace {

constexpr Eigen::Index kMostProducts = 16'384 * 16'384;
constexpr std::uint64_t kCodebookPurpose = 102;  // of derive_seed

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
FeatureMatrix counted_rows(const FeatureTable& table, const Codebook& codebook, std::span<const std::uint32_t> rows) {
  FeatureMatrix counted = FeatureMatrix::Zero(table.features.rows(), codebook.words.rows());
  for (const std::uint32_t row : rows) {
    const std::span<const float> local(table.features.row(row).data(), static_cast<std::size_t>(table.features.cols()));
    std::ranges::copy(codebook.count(local), counted.row(row).data());
  }
  return counted;
}

}  // namespace

bool fits_gram(Eigen::Index rows, Eigen::Index matrices) {
  return rows * rows <= kMostProducts / matrices;
}

Training::Training(const FeatureTable& table, const GramMatrices& gram, std::span<const std::uint32_t> objects,
                   const JudgeSettings& settings)
    : table_(table), has_gram_(!gram.empty()), settings_(settings) {
  const std::vector<std::uint32_t> rows = table.rows_of(objects);
  const bool local = table.local_size > 0;
  const FeatureMatrix& features = local ? learn_words(rows) : table.features;
  const std::vector<std::uint32_t> words = {static_cast<std::uint32_t>(counted_.cols())};
  const std::span<const std::uint32_t> blocks = local ? words : table.blocks;
  training_.emplace(features, local ? counted_gram_ : gram, fit_kernel(settings.kernel, blocks, features, rows),
                    table.row_labels(), rows, static_cast<std::uint32_t>(table.categories.size()));
}

// No products shared with other trainings: each has a codebook, and so features, of its own.
const FeatureMatrix& Training::learn_words(std::span<const std::uint32_t> rows) {
  const std::uint64_t seed = derive_seed(table_.seed, kCodebookPurpose);
  codebook_ = learn_codebook(codebook_samples(table_, rows), table_.words, seed, 1);
  counted_ = counted_rows(table_, codebook_, rows);
  if (fits_gram(counted_.rows(), 1)) {
    const std::vector<std::uint32_t> words = {static_cast<std::uint32_t>(counted_.cols())};
    counted_gram_ = make_shared_gram(settings_.kernel, words, counted_, 1);
  }
  return counted_;
}

std::vector<Judge> Training::train(std::span<const CategoryPair> pairs) const {
  std::vector<Judge> judges;
  judges.reserve(pairs.size());
  for (const CategoryPair pair : pairs) {
    judges.push_back(training_->train(pair, settings_));
  }
  return judges;
}

JudgeList Training::unfilled_list(std::size_t judges) const {
  JudgeList list = training_->unfilled_list(judges);
  list.codebook = codebook_;
  return list;
}

JudgeList Training::list(std::span<const Judge> judges) const {
  JudgeList list = training_->list(judges);
  list.codebook = codebook_;
  return list;
}

FeatureMatrix Training::margins(std::span<const Judge> judges, std::span<const std::uint32_t> objects) const {
  if (has_gram_) {
    std::vector<std::uint32_t> rows;
    for (const std::uint32_t object : objects) {
      for (std::uint32_t view = 0; view < table_.tested_rows; ++view) {
        rows.push_back(object * table_.rows_per_object + view);
      }
    }
    return training_->margins(judges, rows);
  }
  std::vector<std::span<const float>> features;
  for (const std::uint32_t object : objects) {
    for (std::uint32_t view = 0; view < table_.tested_rows; ++view) {
      features.push_back(table_.features_of(object, view));
    }
  }
  return list(judges).margins(features);
}

}  // namespace spincat
