#include "spincat/train/calibration_folds.h"

#include <algorithm>
#include <cstddef>

#include "spincat/dataset/splits.h"
#include "spincat/geometry/random.h"
#include "spincat/judge/ballot.h"
#include "spincat/train/table_familiarity.h"

namespace spincat {
namespace {

constexpr std::uint64_t kCalibrationPurpose = 100;  // of derive_seed

// Objects of the fold, as indices into the table instead of into `objects`.
std::vector<std::uint32_t> picked(std::span<const std::uint32_t> objects, std::span<const std::uint32_t> indices) {
  std::vector<std::uint32_t> result;
  result.reserve(indices.size());
  for (const std::uint32_t i : indices) {
    result.push_back(objects[i]);
  }
  return result;
}

}  // namespace

std::vector<TrainingPlan> calibration_folds(const FeatureTable& table, std::span<const std::uint32_t> objects,
                                            std::uint64_t seed) {
  if (objects.size() < static_cast<std::size_t>(kCalibrationFolds)) {
    return {};
  }
  std::vector<std::uint32_t> labels;
  std::vector<std::size_t> in_category(table.categories.size(), 0);
  for (const std::uint32_t object : objects) {
    labels.push_back(table.objects[object].category);
    ++in_category[labels.back()];
  }
  std::vector<TrainingPlan> trainings;
  for (Split& fold : stratified_folds(labels, kCalibrationFolds, derive_seed(seed, kCalibrationPurpose))) {
    std::vector<std::uint32_t> judged;
    for (const std::uint32_t i : fold.test) {
      (in_category[labels[i]] > 1 ? judged : fold.train).push_back(i);
    }
    std::ranges::sort(fold.train);
    if (!judged.empty()) {
      trainings.push_back({picked(objects, fold.train), picked(objects, judged)});
    }
  }
  return trainings;
}

void FoldCounter::add(const TrainingPlan& fold, const JudgesTask& task, std::string_view result, bool is_last) {
  const FeatureMatrix part = unpack_margins(result, fold.held_out.size() * table_.tested_rows);
  const auto categories = static_cast<Eigen::Index>(table_.categories.size());
  margins_.resize(part.rows(), categories * (categories - 1) / 2);  // does nothing but for the first task of the fold
  margins_.middleCols(task.first, task.last - task.first) = part;
  if (is_last) {
    count(fold);
    margins_.resize(0, 0);
  }
}

Calibration FoldCounter::calibration() const {
  return fit_calibration(votes_, strangers_);
}

// Right and wrong votes of the judges of a fold, and their votes on the same objects as unknown objects.
void FoldCounter::count(const TrainingPlan& fold) {
  const auto categories = static_cast<std::uint32_t>(table_.categories.size());
  const Familiarity familiarity = familiarity_of(table_, fold.train);
  for (std::size_t i = 0; i < fold.held_out.size() * table_.tested_rows; ++i) {
    const std::uint32_t object = fold.held_out[i / table_.tested_rows];
    const std::span<const float> features =
        table_.features_of(object, static_cast<std::uint32_t>(i % table_.tested_rows));
    const std::uint32_t truth = table_.objects[object].category;
    const auto row = static_cast<Eigen::Index>(i);
    const Ballot ballot =
        count_votes(categories, {margins_.row(row).data(), static_cast<std::size_t>(margins_.cols())});
    votes_.push_back({ballot.weakest_margin, ballot.winner == truth, familiarity.of(features, ballot.winner)});
    if (categories > 2) {
      const Ballot as_stranger = ballot_without(ballot, truth);
      strangers_.push_back({as_stranger.weakest_margin, false, familiarity.of(features, as_stranger.winner)});
    }
  }
}

}  // namespace spincat
