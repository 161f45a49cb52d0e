// Training the judges of pairs of categories.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>

#include "spincat/execution.h"
#include "spincat/judge/judge_list.h"
#include "spincat/judge/known_judge.h"
#include "spincat/judge/platt_scaling.h"
#include "spincat/parallel/task_farm.h"
#include "spincat/train/broadcast_table.h"
#include "spincat/train/feature_table.h"

namespace spincat {

struct TrainingPlan;

// Judges, and how far their votes can be trusted.
struct CalibratedJudges {
  JudgeList judges;
  PlattScaling calibration;  // of the winner's weakest margin
  KnownJudge known;          // none where judges learn in no small space
};

// Trains on a table of features. The inner products of all its rows, which every judge needs, are computed once. Pairs
// of categories are independent tasks; so are those of the folds of a calibration. The results do not depend on the
// number of threads and ranks.
class JudgeTrainer {
 public:
  // On all threads of the table's farm, and its ranks where they have the table. What is passed by reference must
  // outlive this object.
  JudgeTrainer(const BroadcastTable& table, const JudgeSettings& settings, const Progress& progress = {});
  // One that knows the inner products (or that there are none), and works on threads of this process.
  JudgeTrainer(const FeatureTable& table, const GramMatrices& gram, const JudgeSettings& settings, int threads);

  // The inner products of the whole table, which all judges use; empty when they would be too large to keep (above
  // a gigabyte: 16,384 rows with one matrix), when the table holds local features or as few columns as a small space:
  // judges then compute their own parts.
  const GramMatrices& gram() const { return *gram_; }

  // Trains the judge of every pair of categories on the given objects and their copies. Where the table holds local
  // features, their codebook is learned first, from these objects alone.
  // Precondition: every category has an object among them.
  JudgeList train(std::span<const std::uint32_t> objects, const Progress& progress = {});

  // The same, and calibrates the confidence by five-fold cross-validation on the given objects alone: each (by all of
  // its views, where it is shown by views) is judged by judges that were trained on the others; so is a fifth of the
  // background. Categories with a single object are always trained on and
  // never judged. Fewer than five objects calibrate nothing.
  CalibratedJudges train_calibrated(std::span<const std::uint32_t> objects, std::uint64_t seed,
                                    const Progress& progress = {});

 private:
  void compute_gram(const Progress& progress);
  CalibratedJudges do_trainings(std::span<const TrainingPlan> trainings, const Progress& progress);

  std::optional<LocalFarm> own_farm_;
  std::optional<BroadcastTable> own_;
  const BroadcastTable& where_;  // the table, and who trains on it
  const FeatureTable& table_;
  const JudgeSettings settings_;
  GramMatrices own_gram_;
  const GramMatrices* gram_ = &own_gram_;
};

}  // namespace spincat
