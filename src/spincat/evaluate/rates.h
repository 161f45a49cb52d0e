// Rates of a confusion matrix, and how far they can be trusted.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#pragma GCC visibility push(default)
namespace spincat {

// n x n counts: row = the truth, column = what the object was named.
using Confusion = std::vector<std::vector<std::uint32_t>>;

// An interval that holds the true rate with 95 % confidence, within 0 to 1.
struct Interval {
  double low = 0.0;
  double high = 1.0;
};

struct Rate {
  double mean = 0.0;
  double deviation = 0.0;  // sample standard deviation over the splits; 0 for a single one
  Interval interval;       // by which method: see the function that made it
};

// The mean over the categories that were tested of the share of their objects that were named right; 0 when none was.
double mean_class_rate(const Confusion& confusion);

// Right votes over all votes; 0 when there are none.
double overall_rate(const Confusion& confusion);

// The interval of a share that was found to be right / all in independent trials (E. B. Wilson, JASA 22, 1927). 0 to 1
// when all is 0. Precondition: right <= all.
Interval wilson_interval(std::uint64_t right, std::uint64_t all);

// The overall rate of objects that were each tested once, with Wilson's interval.
Rate pooled_overall_rate(const Confusion& confusion);

// The mean-class rate of objects that were each tested once. Its interval puts Wilson's intervals of the categories
// together by the recovery of variances (G. Y. Zou and A. Donner, Statistics in Medicine 27, 2008): a category whose
// objects are all right still counts as uncertain.
Rate pooled_mean_class_rate(const Confusion& confusion);

// Mean and deviation of a rate over repeated random splits that test the share `test_share` of the objects. The splits
// share objects, so that their values are not independent: the interval is Student's t with the variance raised by
// test_share / (1 - test_share) (C. Nadeau and Y. Bengio, Machine Learning 52, 2003), which is a correction and no
// proof. 0 to 1 for a single value; without width where all values are equal. Precondition: values is not empty.
Rate rate_over_splits(std::span<const double> values, double test_share);

// The two-sided 95 % point of Student's t distribution: P(|t| <= result) = 0.95. Precondition: degrees >= 1.
double student_t_95(int degrees);

}  // namespace spincat
#pragma GCC visibility pop
