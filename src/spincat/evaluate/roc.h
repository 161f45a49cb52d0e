// How well a number tells two groups apart.
#pragma once

#include <span>

namespace spincat {

// The area under the receiver operating characteristic: the probability that a value from `positives` is larger than
// one from `negatives`, ties counted as one half (the Mann-Whitney statistic). 1: always larger, 0.5: tells nothing.
// 0.5 when either group is empty. Precondition: no NaN.
double area_under_curve(std::span<const double> positives, std::span<const double> negatives);

}  // namespace spincat
