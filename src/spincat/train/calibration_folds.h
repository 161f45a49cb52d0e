// How far votes can be trusted is found out by cross-validation.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "spincat/judge/known_judge.h"
#include "spincat/judge/platt_scaling.h"
#include "spincat/train/feature_table.h"
#include "spincat/train/train_tasks.h"

namespace spincat {

inline constexpr int kCalibrationFolds = 5;

// The folds of a calibration on some objects; none for fewer objects than folds. A category's only object is trained on
// in all of them. Deterministic.
std::vector<TrainingPlan> calibration_folds(const FeatureTable& table, std::span<const std::uint32_t> objects,
                                            std::uint64_t seed);

// What the judges of the folds say, as it comes in, in the order of the tasks.
class FoldCounter {
 public:
  // The table must outlive this object.
  explicit FoldCounter(const FeatureTable& table) : table_(table) {}

  // `is_last`: of the tasks of this fold.
  void add(const TrainingPlan& fold, const JudgesTask& task, std::string_view result, bool is_last);

  // Of the votes of all folds so far; that of none takes every vote as it comes.
  PlattScaling calibration() const { return fit_platt(votes_); }
  // The same for the judge of known and unknown.
  void calibrate(KnownJudge& judge) const { calibrate_known(known_, strangers_, judge); }

 private:
  void count(const TrainingPlan& fold);

  const FeatureTable& table_;
  FeatureMatrix margins_;          // of the fold that is coming in
  std::vector<Scored> votes_;      // the winner's smallest margin over all its judges
  std::vector<double> known_;      // margins of the judge of known and unknown: of held-out objects and their copies
  std::vector<double> strangers_;  // of the background that was held out
};

}  // namespace spincat
