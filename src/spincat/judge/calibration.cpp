#include "spincat/judge/calibration.h"

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace spincat {
namespace {

double logistic(double t) {
  return 1.0 / (1.0 + std::exp(-t));
}

// log(1 + exp(t)), which does not overflow.
double soft_plus(double t) {
  return std::max(t, 0.0) + std::log1p(std::exp(-std::abs(t)));
}

// What is minimised over (slope, offset): minus the log-likelihood of the votes with Platt's softened targets, and a
// small pull towards the uncalibrated values where the votes say nothing.
class Loss {
 public:
  explicit Loss(std::span<const JudgedObject> votes) : votes_(votes) {
    const auto right = static_cast<double>(std::ranges::count_if(votes, &JudgedObject::right));
    const auto wrong = static_cast<double>(votes.size()) - right;
    target_right_ = (right + 1.0) / (right + 2.0);
    target_wrong_ = 1.0 / (wrong + 2.0);
    mean_target_ = (right * target_right_ + wrong * target_wrong_) / static_cast<double>(votes.size());
  }

  double value(const Eigen::Vector2d& x) const {
    double sum = 0.5 * kRidge * (x - start_).squaredNorm();
    for (const JudgedObject& vote : votes_) {
      const double t = x[0] * vote.weakest_margin + x[1];
      sum += soft_plus(t) - target(vote) * t;
    }
    return sum;
  }

  // Newton's step from `x`, and by how much the loss falls at first along it.
  std::pair<Eigen::Vector2d, double> step(const Eigen::Vector2d& x) const {
    Eigen::Vector2d gradient = kRidge * (x - start_);
    Eigen::Matrix2d curvature = kRidge * Eigen::Matrix2d::Identity();
    for (const JudgedObject& vote : votes_) {
      const Eigen::Vector2d features(vote.weakest_margin, 1.0);
      const double p = logistic(x.dot(features));
      gradient += (p - target(vote)) * features;
      curvature += p * (1.0 - p) * features * features.transpose();
    }
    const Eigen::Vector2d change = -curvature.inverse() * gradient;
    return {change, -gradient.dot(change)};
  }

  const Eigen::Vector2d& start() const { return start_; }
  double mean_target() const { return mean_target_; }

 private:
  static constexpr double kRidge = 1e-3;

  double target(const JudgedObject& vote) const { return vote.right ? target_right_ : target_wrong_; }

  std::span<const JudgedObject> votes_;
  Eigen::Vector2d start_{Calibration{}.slope, Calibration{}.offset};
  double target_right_ = 1.0;
  double target_wrong_ = 0.0;
  double mean_target_ = 0.5;
};

// The loss is convex: Newton's steps, each halved until it helps, find the only minimum from anywhere.
Eigen::Vector2d minimum_of(const Loss& loss) {
  constexpr int kMostSteps = 100;
  constexpr double kShortest = 1e-6;    // part of a step
  constexpr double kConverged = 1e-11;  // fall of the loss, relative to it; rounding hides less
  Eigen::Vector2d x = loss.start();
  double value = loss.value(x);
  for (int i = 0; i < kMostSteps; ++i) {
    const auto [step, fall] = loss.step(x);
    if (!(fall > kConverged * (1.0 + value))) {
      break;
    }
    double part = 1.0;
    while (part > kShortest && loss.value(x + part * step) > value - 1e-4 * part * fall) {
      part *= 0.5;
    }
    x += part * step;
    value = loss.value(x);
  }
  return x;
}

}  // namespace

double Calibration::confidence(const Ballot& ballot) const {
  return logistic(std::clamp(slope * ballot.weakest_margin + offset, -30.0, 30.0));
}

Calibration fit_calibration(std::span<const JudgedObject> votes) {
  constexpr std::size_t kFewestVotes = 10;
  if (votes.size() < kFewestVotes) {
    return {};
  }
  const Loss loss(votes);
  const Eigen::Vector2d x = minimum_of(loss);
  if (x[0] >= 0.0) {
    return {x[0], x[1]};
  }
  // A larger margin must never mean less confidence: then every margin means the same.
  return {0.0, std::log(loss.mean_target() / (1.0 - loss.mean_target()))};
}

}  // namespace spincat
