#include "spincat/train/training.h"

#include <algorithm>
#include <cstddef>
#include <iterator>

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
  const std::vector<std::uint32_t> labels = table.row_labels();
  const auto categories = static_cast<std::uint32_t>(table.categories.size());
  if (settings.dimensions > 0) {
    rows_ = rows;
    space_ = learn_space(table.features, gram, labels, rows, settings.dimensions);
    training_.emplace(space_->places, no_gram_, Kernel{}, labels, rows, categories);
    return;
  }
  const bool local = table.local_size > 0;
  const FeatureMatrix& features = local ? learn_words(rows) : table.features;
  const std::vector<std::uint32_t> words = {static_cast<std::uint32_t>(counted_.cols())};
  const std::span<const std::uint32_t> blocks = local ? words : table.blocks;
  training_.emplace(features, local ? counted_gram_ : gram, fit_kernel(settings.kernel, blocks, features, rows), labels,
                    rows, categories);
}

std::size_t Training::seen_length() const {
  const FeatureMatrix& seen = space_ ? space_->places : table_.local_size > 0 ? counted_ : table_.features;
  return static_cast<std::size_t>(seen.cols());
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
  if (space_) {
    list.whitening = Whitening(after_basis(space_->whitening(table_.features), table_.basis));
  }
  return list;
}

JudgeList Training::list(std::span<const Judge> judges) const {
  JudgeList list = training_->list(judges);
  list.codebook = codebook_;
  if (space_) {
    list.whitening = Whitening(after_basis(space_->whitening(table_.features), table_.basis));
  }
  return list;
}

KnownJudge Training::train_known_judge(std::span<const std::uint32_t> but) const {
  std::vector<std::uint32_t> background;
  std::ranges::set_difference(table_.rows_of_background(), but, std::back_inserter(background));
  std::vector<RowOrigin> origins;
  const std::vector<std::uint32_t> labels = table_.row_labels();
  for (const std::uint32_t row : rows_) {
    origins.push_back({labels[row], row / table_.rows_per_object});
  }
  // What the user says is of no category is taken for that.
  const auto shapes = std::ranges::lower_bound(
      background, static_cast<std::uint32_t>(table_.features.rows()) - table_.background_rows + table_.other_rows);
  std::vector<std::uint32_t> unlike(background.begin(), shapes);
  std::ranges::copy(unlike_known(space_->places, rows_, origins, {shapes, background.end()}),
                    std::back_inserter(unlike));
  return unlike.empty() ? KnownJudge{} : spincat::train_known_judge(space_->places, rows_, unlike);
}

std::vector<double> Training::known_margins(const KnownJudge& judge, std::span<const std::uint32_t> rows) const {
  std::vector<double> margins;
  for (const std::uint32_t row : judge.empty() ? std::span<const std::uint32_t>() : rows) {
    const auto place = space_->places.row(row);
    margins.push_back(static_cast<double>(judge.margin({place.data(), static_cast<std::size_t>(place.size())})));
  }
  return margins;
}

std::vector<std::uint32_t> Training::tested_rows_of(std::span<const std::uint32_t> objects) const {
  std::vector<std::uint32_t> rows;
  for (const std::uint32_t object : objects) {
    for (std::uint32_t view = 0; view < table_.tested_rows; ++view) {
      rows.push_back(object * table_.rows_per_object + view);
    }
  }
  return rows;
}

FeatureMatrix Training::margins(std::span<const Judge> judges, std::span<const std::uint32_t> objects) const {
  if (has_gram_ || space_) {
    return training_->margins(judges, tested_rows_of(objects));
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
