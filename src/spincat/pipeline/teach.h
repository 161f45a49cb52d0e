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

// The inner products of the whole table, which all judges then share; empty when they would be too large to keep (above
// a gigabyte: 16,384 rows with one matrix), or when the table holds local features: judges then compute their own
// parts.
SharedGram shared_gram(const FeatureTable& table, const JudgeSettings& settings, int threads);

// Teaches the judge of every pair of categories on the given objects and their copies. Where the table holds local
// features, their codebook is learned first, from these objects alone. The result does not depend on
// `threads`. Precondition: every category has an object among them.
JudgeList teach_judges(const FeatureTable& table, const SharedGram& gram, std::span<const std::uint32_t> objects,
                       const JudgeSettings& settings, int threads, const Progress& progress);

// The given objects as familiarity sees them: the first part of their features (what is seen from outside), without
// copies: strangers stand out in it more than in all parts together (docs/accuracy.md). Empty where the table has none to compare
// objects by.
Familiarity familiarity_of(const FeatureTable& table, std::span<const std::uint32_t> objects);

// Calibrates the confidence by five-fold cross-validation on the given objects alone: each is judged by judges that
// were taught on the others, and once more as a stranger, without the judges that know its category. Categories with a
// single object are always taught on and never judged.
Calibration calibrate(const FeatureTable& table, const SharedGram& gram, std::span<const std::uint32_t> objects,
                      const JudgeSettings& settings, std::uint64_t seed, int threads, const Progress& progress);

}  // namespace spincat
