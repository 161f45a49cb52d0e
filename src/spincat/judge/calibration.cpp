#include "spincat/judge/calibration.h"

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace spincat {
namespace {

double logistic(double t) {
  return 1.0 / (1.0 + std::exp(-t));
}

// log(1 + exp(t)), which does not overflow.
double soft_plus(double t) {
  return std::max(t, 0.0) + std::log1p(std::exp(-std::abs(t)));
}

// What is minimised over (slope, offset, familiarity_slope): minus the log-likelihood of the votes with Platt's
// softened targets, and a small pull towards the uncalibrated values where the votes say nothing.
class Loss {
 public:
  explicit Loss(std::span<const JudgedObject> votes) : votes_(votes) {
    const auto right = static_cast<double>(std::ranges::count_if(votes, &JudgedObject::right));
    const auto wrong = static_cast<double>(votes.size()) - right;
    target_right_ = (right + 1.0) / (right + 2.0);
    target_wrong_ = 1.0 / (wrong + 2.0);
    mean_target_ = (right * target_right_ + wrong * target_wrong_) / static_cast<double>(votes.size());
  }

  double value(const Eigen::Vector3d& x) const {
    double sum = 0.5 * kRidge * (x - start_).squaredNorm();
    for (const JudgedObject& vote : votes_) {
      const double t = x.dot(inputs(vote));
      sum += soft_plus(t) - target(vote) * t;
    }
    return sum;
  }

  // Newton's step from `x`, and by how much the loss falls at first along it.
  std::pair<Eigen::Vector3d, double> step(const Eigen::Vector3d& x) const {
    Eigen::Vector3d gradient = kRidge * (x - start_);
    Eigen::Matrix3d curvature = kRidge * Eigen::Matrix3d::Identity();
    for (const JudgedObject& vote : votes_) {
      const Eigen::Vector3d features = inputs(vote);
      const double p = logistic(x.dot(features));
      gradient += (p - target(vote)) * features;
      curvature += p * (1.0 - p) * features * features.transpose();
    }
    const Eigen::Vector3d change = -curvature.inverse() * gradient;
    return {change, -gradient.dot(change)};
  }

  const Eigen::Vector3d& start() const { return start_; }
  double mean_target() const { return mean_target_; }

 private:
  static constexpr double kRidge = 1e-3;

  static Eigen::Vector3d inputs(const JudgedObject& vote) { return {vote.weakest_margin, 1.0, vote.familiarity}; }
  double target(const JudgedObject& vote) const { return vote.right ? target_right_ : target_wrong_; }

  std::span<const JudgedObject> votes_;
  Eigen::Vector3d start_{Calibration{}.slope, Calibration{}.offset, Calibration{}.familiarity_slope};
  double target_right_ = 1.0;
  double target_wrong_ = 0.0;
  double mean_target_ = 0.5;
};

// The loss is convex: Newton's steps, each halved until it helps, find the only minimum from anywhere.
Eigen::Vector3d minimum_of(const Loss& loss) {
  constexpr int kMostSteps = 100;
  constexpr double kShortest = 1e-6;    // part of a step
  constexpr double kConverged = 1e-11;  // fall of the loss, relative to it; rounding hides less
  Eigen::Vector3d x = loss.start();
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

// Platt scaling of the weakest margin alone.
Calibration fit_to_margins(std::span<const JudgedObject> votes) {
  const Loss loss(votes);
  const Eigen::Vector3d x = minimum_of(loss);
  if (x[0] >= 0.0) {
    return {x[0], x[1], 0.0};
  }
  // A larger margin must never mean less confidence: then every margin means the same.
  return {0.0, std::log(loss.mean_target() / (1.0 - loss.mean_target())), 0.0};
}

JudgedObject without_familiarity(JudgedObject vote) {
  vote.familiarity = 0.0;
  return vote;
}

// How much familiarity counts for one of margin, found by telling right votes from wrong ones and unknown objects, but
// at least as much: categories of one data set are more like each other than what a user will come with, so that they
// teach too little of it. Nothing where either would count against the vote.
double weight_of_familiarity(std::span<const JudgedObject> votes, std::span<const JudgedObject> unknown_objects) {
  std::vector<JudgedObject> all(votes.begin(), votes.end());
  all.insert(all.end(), unknown_objects.begin(), unknown_objects.end());
  const Eigen::Vector3d x = minimum_of(Loss(all));
  constexpr double kLeastSlope = 1e-6;
  constexpr double kLeastWeight = 1.0;  // docs/how-it-works/confidence.md says what was measured for it
  return x[0] > kLeastSlope && x[2] > 0.0 ? std::max(kLeastWeight, x[2] / x[0]) : 0.0;
}

}  // namespace

double Calibration::confidence(const Ballot& ballot, double familiarity) const {
  const double t = slope * ballot.weakest_margin + familiarity_slope * familiarity + offset;
  return logistic(std::clamp(t, -30.0, 30.0));
}

Calibration fit_calibration(std::span<const JudgedObject> votes, std::span<const JudgedObject> unknown_objects) {
  constexpr std::size_t kFewestVotes = 10;
  if (votes.size() < kFewestVotes) {
    return {};
  }
  const double weight = unknown_objects.empty() ? 0.0 : weight_of_familiarity(votes, unknown_objects);
  std::vector<JudgedObject> weighed;
  for (const JudgedObject& vote : votes) {
    weighed.push_back(without_familiarity(vote));
    weighed.back().weakest_margin += weight * vote.familiarity;
  }
  Calibration calibration = fit_to_margins(weighed);
  calibration.familiarity_slope = weight * calibration.slope;
  return calibration;
}

}  // namespace spincat
