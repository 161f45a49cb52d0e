// Training judges on all threads and ranks of a farm.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>

#include "spincat/execution.h"
#include "spincat/judge/calibration.h"
#include "spincat/judge/judge_list.h"
#include "spincat/parallel/task_farm.h"
#include "spincat/train/feature_table.h"
#include "spincat/train/worth_broadcasting.h"

namespace spincat {

struct TableTicket;
struct TrainingPlan;

// Judges, and how far their votes can be trusted.
struct CalibratedJudges {
  JudgeList judges;
  Calibration calibration;
};

// Trains on a table of features. The inner products of all its rows, which every judge needs, are computed once. Pairs
// of categories are independent tasks; so are those of the folds of a calibration. The results do not depend on the
// number of threads and ranks.
class JudgeTrainer {
 public:
  // Gives the other ranks the table where they do not have it and that pays (worth_broadcasting.h). What is passed by
  // reference must outlive this object.
  JudgeTrainer(const FeatureTable& table, const JudgeSettings& settings, TaskFarm& farm, std::size_t trainings,
               const Progress& progress = {});
  // One that knows the inner products (or that there are none), and works on threads of this process.
  JudgeTrainer(const FeatureTable& table, const GramMatrices& gram, const JudgeSettings& settings, int threads);

  // The inner products of the whole table, which all judges share; empty when they would be too large to keep (above
  // a gigabyte: 16,384 rows with one matrix), or when the table holds local features: judges then compute their own
  // parts.
  const GramMatrices& gram() const { return *gram_; }

  // What other ranks should keep (train_tasks.h).
  TableTicket expected() const;

  // Where jobs are done, and whether by all ranks: those that have the table.
  TaskFarm& farm() { return *farm_; }
  bool is_shared() const { return shared_as_ != 0; }

  // Trains the judge of every pair of categories on the given objects and their copies. Where the table holds local
  // features, their codebook is learned first, from these objects alone.
  // Precondition: every category has an object among them.
  JudgeList train(std::span<const std::uint32_t> objects, const Progress& progress = {});

  // The same, and calibrates the confidence by five-fold cross-validation on the given objects alone: each (by all of
  // its views, where it is shown by views) is judged by judges that were trained on the others, and once more as a
  // stranger, without the judges that know its category. Categories with a single object are always trained on and
  // never judged. Fewer than five objects calibrate nothing.
  CalibratedJudges train_calibrated(std::span<const std::uint32_t> objects, std::uint64_t seed,
                                    const Progress& progress = {});

 private:
  void compute_gram(const Progress& progress);
  CalibratedJudges do_trainings(std::span<const TrainingPlan> trainings, const Progress& progress);

  const FeatureTable& table_;
  const JudgeSettings settings_;
  std::optional<LocalFarm> own_;
  TaskFarm* farm_;
  std::uint64_t shared_as_ = 0;
  GramMatrices own_gram_;
  const GramMatrices* gram_ = &own_gram_;
};

}  // namespace spincat
