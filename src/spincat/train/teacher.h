// Teaching judges on all threads and ranks of a farm.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>

#include "spincat/describe/progress.h"
#include "spincat/judge/calibration.h"
#include "spincat/judge/judge_list.h"
#include "spincat/parallel/task_farm.h"
#include "spincat/train/feature_table.h"
#include "spincat/train/sharing.h"

namespace spincat {

struct Expected;
struct LessonPlan;

// Judges, and how far their votes can be trusted.
struct CalibratedJudges {
  JudgeList judges;
  Calibration calibration;
};

// Teaches on a table of features. The inner products of all its rows, which every judge needs, are computed once. Pairs
// of categories are independent tasks; so are those of the folds of a calibration. The results do not depend on the
// number of threads and ranks.
class Teacher {
 public:
  // Gives the other ranks the table where they do not have it and that pays (sharing.h). What is passed by
  // reference must outlive this object.
  Teacher(const FeatureTable& table, const JudgeSettings& settings, TaskFarm& farm, const TeachingPlan& plan,
          const Progress& progress = {});
  // One that knows the inner products (or that there are none), and works on threads of this process.
  Teacher(const FeatureTable& table, const SharedGram& gram, const JudgeSettings& settings, int threads);

  // The inner products of the whole table, which all judges share; empty when they would be too large to keep (above
  // a gigabyte: 16,384 rows with one matrix), or when the table holds local features: judges then compute their own
  // parts.
  const SharedGram& gram() const { return *gram_; }

  // What other ranks should keep (teach_tasks.h).
  Expected expected() const;

  // Where jobs are done, and whether by all ranks: those that have the table.
  TaskFarm& farm() { return *farm_; }
  bool is_shared() const { return shared_as_ != 0; }

  // Teaches the judge of every pair of categories on the given objects and their copies. Where the table holds local
  // features, their codebook is learned first, from these objects alone.
  // Precondition: every category has an object among them.
  JudgeList teach(std::span<const std::uint32_t> objects, const Progress& progress = {});

  // The same, and calibrates the confidence by five-fold cross-validation on the given objects alone: each (by all of
  // its views, where it is shown by views) is judged by judges that were taught on the others, and once more as a
  // stranger, without the judges that know its category. Categories with a single object are always taught on and never
  // judged. Fewer than five objects calibrate nothing.
  CalibratedJudges teach_calibrated(std::span<const std::uint32_t> objects, std::uint64_t seed,
                                    const Progress& progress = {});

 private:
  void compute_gram(const Progress& progress);
  CalibratedJudges do_lessons(std::span<const LessonPlan> lessons, const Progress& progress);

  const FeatureTable& table_;
  const JudgeSettings settings_;
  std::optional<OwnFarm> own_;
  TaskFarm* farm_;
  std::uint64_t shared_as_ = 0;
  SharedGram own_gram_;
  const SharedGram* gram_ = &own_gram_;
};

}  // namespace spincat
