// From a decision value to a probability.
//
// Source: J. C. Platt, "Probabilistic outputs for support vector machines", 1999.
#pragma once

#include <span>

namespace spincat {

// A decision value and what was true.
struct Scored {
  double value = 0.0;
  bool positive = false;
  double weight = 1.0;  // > 0
};

// probability = 1 / (1 + exp(-(slope value + offset)))
struct PlattScaling {
  double slope = 2.0;  // before it is fitted: one half at 0, 0.88 at 1
  double offset = 0.0;

  double probability(double value) const;  // in (0, 1)
};

// The maximum of the likelihood, with softened targets, so that a handful of values or values that are all positive do
// not give certainty. A larger value never means less: where it would, every value means the same. Unfitted for fewer
// than ten. Deterministic.
PlattScaling fit_platt(std::span<const Scored> scored);

}  // namespace spincat
