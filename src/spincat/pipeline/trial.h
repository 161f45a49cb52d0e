// Private to the library, not installed: one trial of an evaluation.
#pragma once

#include <cstdint>
#include <vector>

#include "spincat/dataset/splits.h"
#include "spincat/judge/kernel.h"
#include "spincat/pipeline/evaluate.h"

namespace spincat {

// What came of one trial.
struct Trial {
  Confusion confusion;
  std::vector<std::uint32_t> named;  // for each of split.test: the category it was given
  // The confidences, where they are measured: in the tested objects by whether they were named right, and in strangers.
  std::vector<double> right;
  std::vector<double> wrong;
  std::vector<double> strangers;
};

// Teaches the judges on the objects `split.train` of the table and lets them vote on the tested objects `split.test`.
// Deterministic.
Trial run_trial(const EvaluationData& data, const SharedGram& gram, const Split& split, const Settings& settings,
                bool measure_confidence, int threads);

}  // namespace spincat
