#include "spincat/judge/known_judge.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "spincat/geometry/evenly_spread.h"
#include "spincat/judge/fixed_product.h"
#include "spincat/judge/linear_svm.h"

namespace spincat {
namespace {

constexpr double kC = 50.0;
constexpr std::size_t kMostCompared = 1500;  // of the known rows: their square is worked with
constexpr double kTurnedAway = 0.03;         // of the known objects
constexpr double kAsLike = 0.9;              // quantile
constexpr std::size_t kFewestMargins = 10;

// For each row how like it is the nearest of another object of its category; rows that have none are left out.
std::vector<float> likeness_within(const FeatureMatrix& rows, std::span<const RowOrigin> origins) {
  const FeatureMatrix alike = product_with_transposed<float>(rows, rows);
  std::vector<float> nearest;
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    const RowOrigin& own = origins[static_cast<std::size_t>(i)];
    std::optional<float> most;
    for (Eigen::Index j = 0; j < rows.rows(); ++j) {
      const RowOrigin& other = origins[static_cast<std::size_t>(j)];
      if (other.category == own.category && other.object != own.object) {
        most = std::max(most.value_or(alike(i, j)), alike(i, j));
      }
    }
    if (most) {
      nearest.push_back(*most);
    }
  }
  return nearest;
}

std::vector<Scored> scored(std::span<const double> known, std::span<const double> strangers) {
  const double all = static_cast<double>(known.size() + strangers.size());
  std::vector<Scored> result;
  for (const double margin : known) {
    result.push_back({margin, true, 0.5 * all / static_cast<double>(known.size())});
  }
  for (const double margin : strangers) {
    result.push_back({margin, false, 0.5 * all / static_cast<double>(strangers.size())});
  }
  return result;
}

}  // namespace

float KnownJudge::margin(std::span<const float> seen) const {
  return weights.dot(Eigen::Map<const Eigen::RowVectorXf>(seen.data(), weights.size())) + bias;
}

std::vector<std::uint32_t> unlike_known(const FeatureMatrix& seen, std::span<const std::uint32_t> known,
                                        std::span<const RowOrigin> origins, std::span<const std::uint32_t> background) {
  const FeatureMatrix rows = seen(evenly_spread(known, kMostCompared), Eigen::all);
  std::vector<float> within = likeness_within(rows, evenly_spread(origins, kMostCompared));
  if (within.empty()) {
    return {background.begin(), background.end()};
  }
  const auto border = within.begin() + static_cast<std::ptrdiff_t>(kAsLike * static_cast<double>(within.size() - 1));
  std::ranges::nth_element(within, border);
  const FeatureMatrix alike = product_with_transposed<float>(FeatureMatrix(seen(background, Eigen::all)), rows);
  std::vector<std::uint32_t> unlike;
  for (std::size_t i = 0; i < background.size(); ++i) {
    if (alike.row(static_cast<Eigen::Index>(i)).maxCoeff() < *border) {
      unlike.push_back(background[i]);
    }
  }
  return unlike;
}

KnownJudge train_known_judge(const FeatureMatrix& seen, std::span<const std::uint32_t> known,
                             std::span<const std::uint32_t> background) {
  std::vector<std::uint32_t> rows(known.begin(), known.end());
  const auto first_count = static_cast<std::uint32_t>(rows.size());
  rows.insert(rows.end(), background.begin(), background.end());
  const auto price = [&](std::size_t count) {
    return kC * static_cast<double>(rows.size()) / (2.0 * static_cast<double>(count));
  };
  const FeatureMatrix features = seen(rows, Eigen::all);
  const PairwiseSvm svm = train_linear_svm(features, first_count, price(known.size()), price(background.size()));
  Eigen::RowVectorXd weights = Eigen::RowVectorXd::Zero(seen.cols());
  for (std::size_t s = 0; s < svm.object.size(); ++s) {
    weights += svm.coefficient[s] * features.row(svm.object[s]).cast<double>();
  }
  KnownJudge judge;
  judge.weights = weights.cast<float>();
  judge.bias = static_cast<float>(svm.bias);
  return judge;
}

void calibrate_known(std::span<const double> known, std::span<const double> strangers, KnownJudge& judge) {
  if (std::min(known.size(), strangers.size()) < kFewestMargins) {
    return;
  }
  judge.scaling = fit_platt(scored(known, strangers));
  std::vector<double> margins(known.begin(), known.end());
  const auto least = margins.begin() + static_cast<std::ptrdiff_t>(kTurnedAway * static_cast<double>(margins.size()));
  std::ranges::nth_element(margins, least);
  judge.least = judge.scaling.probability(*least);
}

}  // namespace spincat
