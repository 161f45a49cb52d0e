// Teaching all judges, on threads.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>

#include "spincat/judge/calibration.h"
#include "spincat/judge/familiarity.h"
#include "spincat/judge/judge_list.h"
#include "spincat/pipeline/feature_table.h"
#include "spincat/pipeline/progress.h"

namespace spincat {

// The Gram matrix of the whole table, which all judges then share; empty when it would be too large to keep (more than
// 16,384 rows, a gigabyte): judges then compute their own parts.
Eigen::MatrixXf shared_gram(const FeatureTable& table, int threads);

// Teaches the judge of every pair of categories on the given objects and their copies. The result does not depend on
// `threads`. Precondition: every category has an object among them.
JudgeList teach_judges(const FeatureTable& table, const Eigen::MatrixXf& gram, std::span<const std::uint32_t> objects,
                       const JudgeSettings& settings, int threads, const Progress& progress);

// The given objects as familiarity sees them: their features, without copies. Empty where the table has none to compare
// objects by.
Familiarity familiarity_of(const FeatureTable& table, std::span<const std::uint32_t> objects);

// Calibrates the confidence by five-fold cross-validation on the given objects alone: each is judged by judges that
// were taught on the others, and once more as a stranger, without the judges that know its category. Categories with a
// single object are always taught on and never judged.
Calibration calibrate(const FeatureTable& table, const Eigen::MatrixXf& gram, std::span<const std::uint32_t> objects,
                      const JudgeSettings& settings, std::uint64_t seed, int threads, const Progress& progress);

}  // namespace spincat
