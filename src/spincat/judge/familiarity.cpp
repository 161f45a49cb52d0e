#include "spincat/judge/familiarity.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace spincat {
namespace {

// Smallest squared distance to the rows of a category, but for those from `but` to `but_end`; infinite where there is
// none.
double nearest(const Familiarity& f, const Eigen::Ref<const Eigen::RowVectorXf>& x, std::uint32_t category,
               std::size_t but, std::size_t but_end) {
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < f.labels.size(); ++i) {
    if ((i < but || i >= but_end) && f.labels[i] == category) {
      smallest = std::min<double>(smallest, (f.objects.row(static_cast<Eigen::Index>(i)) - x).squaredNorm());
    }
  }
  return smallest;
}

double mean_of(std::span<const double> values) {
  double sum = 0.0;
  for (const double value : values) {
    sum += value;
  }
  return values.empty() ? 0.0 : sum / static_cast<double>(values.size());
}

double deviation_of(std::span<const double> values) {
  const double mean = mean_of(values);
  double squares = 0.0;
  for (const double value : values) {
    squares += (value - mean) * (value - mean);
  }
  return values.empty() ? 0.0 : std::sqrt(squares / static_cast<double>(values.size()));
}

}  // namespace

double Familiarity::of(std::span<const float> features, std::uint32_t category) const {
  if (empty()) {
    return 0.0;
  }
  const Eigen::Map<const Eigen::RowVectorXf> x(features.data(), objects.cols());
  return (typical[category] - nearest(*this, x, category, 0, 0)) / spread[category];
}

Familiarity make_familiarity(FeatureMatrix objects, std::vector<std::uint32_t> labels, std::uint32_t categories,
                             std::uint32_t rows_each) {
  constexpr double kShareOfMean = 0.2;
  constexpr double kLeastSpread = 1e-12;  // where all objects are equal
  Familiarity result{std::move(objects), std::move(labels), std::vector<float>(categories),
                     std::vector<float>(categories)};
  std::vector<std::vector<double>> distances(categories);
  std::vector<double> all;
  for (std::size_t i = 0; i < result.labels.size(); ++i) {
    const std::size_t own = i - i % rows_each;
    const double d =
        nearest(result, result.objects.row(static_cast<Eigen::Index>(i)), result.labels[i], own, own + rows_each);
    if (std::isfinite(d)) {
      distances[result.labels[i]].push_back(d);
      all.push_back(d);
    }
  }
  const double overall = mean_of(all);
  for (std::uint32_t c = 0; c < categories; ++c) {
    const bool known = !distances[c].empty();
    result.typical[c] = static_cast<float>(known ? mean_of(distances[c]) : overall);
    const double deviation = deviation_of(known ? distances[c] : all);
    result.spread[c] = static_cast<float>(std::max(deviation + kShareOfMean * overall, kLeastSpread));
  }
  return result;
}

}  // namespace spincat
