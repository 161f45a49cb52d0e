#include "spincat/judge/calibration.h"

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstddef>

namespace spincat {
namespace {

double logistic(double t) {
  return 1.0 / (1.0 + std::exp(-t));
}

}  // namespace

double Calibration::confidence(const Ballot& ballot) const {
  return logistic(std::clamp(slope * ballot.weakest_margin + offset, -30.0, 30.0));
}

Calibration fit_calibration(std::span<const JudgedObject> votes) {
  constexpr std::size_t kFewestVotes = 10;
  constexpr int kSteps = 50;
  constexpr double kRidge = 1e-3;  // pulls towards the uncalibrated values where the votes say nothing
  const Calibration uncalibrated;
  if (votes.size() < kFewestVotes) {
    return uncalibrated;
  }
  const auto right = static_cast<double>(std::ranges::count_if(votes, &JudgedObject::right));
  const auto wrong = static_cast<double>(votes.size()) - right;
  const double target_right = (right + 1.0) / (right + 2.0);
  const double target_wrong = 1.0 / (wrong + 2.0);
  const Eigen::Vector2d start(uncalibrated.slope, uncalibrated.offset);
  Eigen::Vector2d x = start;
  for (int step = 0; step < kSteps; ++step) {
    Eigen::Vector2d gradient = kRidge * (x - start);
    Eigen::Matrix2d curvature = kRidge * Eigen::Matrix2d::Identity();
    for (const JudgedObject& vote : votes) {
      const Eigen::Vector2d features(vote.weakest_margin, 1.0);
      const double p = logistic(x.dot(features));
      gradient += (p - (vote.right ? target_right : target_wrong)) * features;
      curvature += std::max(p * (1.0 - p), 1e-6) * features * features.transpose();
    }
    const Eigen::Vector2d change = curvature.inverse() * gradient;
    x -= change / std::max(1.0, change.norm());  // at most a step of 1: the likelihood is concave, but not quadratic
    if (change.norm() < 1e-9) {
      break;
    }
  }
  // A larger margin must never mean less confidence.
  return {std::max(x[0], 0.0), x[1]};
}

}  // namespace spincat
