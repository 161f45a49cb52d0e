#include "spincat/train/calibration_folds.h"

#include <algorithm>
#include <cstddef>

#include "spincat/dataset/splits.h"
#include "spincat/geometry/random.h"
#include "spincat/judge/ballot.h"

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

std::vector<std::uint32_t> every_fifth(std::span<const std::uint32_t> rows, std::size_t first) {
  std::vector<std::uint32_t> result;
  for (std::size_t i = first; i < rows.size(); i += kCalibrationFolds) {
    result.push_back(rows[i]);
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
  const std::vector<std::uint32_t> background = table.rows_of_background();
  std::vector<TrainingPlan> trainings;
  for (Split& fold : stratified_folds(labels, kCalibrationFolds, derive_seed(seed, kCalibrationPurpose))) {
    std::vector<std::uint32_t> judged;
    for (const std::uint32_t i : fold.test) {
      (in_category[labels[i]] > 1 ? judged : fold.train).push_back(i);
    }
    std::ranges::sort(fold.train);
    const std::size_t number = trainings.size();
    if (!judged.empty()) {
      trainings.push_back({picked(objects, fold.train), picked(objects, judged), every_fifth(background, number)});
    }
  }
  return trainings;
}

void FoldCounter::add(const TrainingPlan& fold, const JudgesTask& task, std::string_view result, bool is_last) {
  if (task.is_of_known_judge()) {
    const auto [known, strangers] = unpack<KnownMargins>(result);
    known_.insert(known_.end(), known.begin(), known.end());
    strangers_.insert(strangers_.end(), strangers.begin(), strangers.end());
    return;
  }
  const FeatureMatrix part = unpack_margins(result, fold.held_out.size() * table_.tested_rows);
  const auto categories = static_cast<Eigen::Index>(table_.categories.size());
  margins_.resize(part.rows(), categories * (categories - 1) / 2);  // does nothing but for the first task of the fold
  margins_.middleCols(task.first, task.last - task.first) = part;
  if (is_last) {
    count(fold);
    margins_.resize(0, 0);
  }
}

// Right and wrong votes of the judges of a fold.
void FoldCounter::count(const TrainingPlan& fold) {
  const auto categories = static_cast<std::uint32_t>(table_.categories.size());
  for (std::size_t i = 0; i < fold.held_out.size() * table_.tested_rows; ++i) {
    const std::uint32_t truth = table_.objects[fold.held_out[i / table_.tested_rows]].category;
    const auto row = static_cast<Eigen::Index>(i);
    const Ballot ballot =
        count_votes(categories, {margins_.row(row).data(), static_cast<std::size_t>(margins_.cols())});
    votes_.push_back({static_cast<double>(ballot.weakest_margin), ballot.winner == truth});
  }
}

}  // namespace spincat
