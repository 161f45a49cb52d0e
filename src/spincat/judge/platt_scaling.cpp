#include "spincat/judge/platt_scaling.h"

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

// What is minimised over (slope, offset): minus the log-likelihood with Platt's softened targets, and a small pull
// towards the unfitted values where the data say nothing.
class Loss {
 public:
  explicit Loss(std::span<const Scored> scored) : scored_(scored) {
    double positive = 0.0;
    double negative = 0.0;
    for (const Scored& one : scored) {
      (one.positive ? positive : negative) += one.weight;
    }
    target_positive_ = (positive + 1.0) / (positive + 2.0);
    target_negative_ = 1.0 / (negative + 2.0);
    mean_target_ = (positive * target_positive_ + negative * target_negative_) / (positive + negative);
  }

  double value(const Eigen::Vector2d& x) const {
    double sum = 0.5 * kRidge * (x - start_).squaredNorm();
    for (const Scored& one : scored_) {
      const double t = x.dot(inputs(one));
      sum += one.weight * (soft_plus(t) - target(one) * t);
    }
    return sum;
  }

  // Newton's step from `x`, and by how much the loss falls at first along it.
  std::pair<Eigen::Vector2d, double> step(const Eigen::Vector2d& x) const {
    Eigen::Vector2d gradient = kRidge * (x - start_);
    Eigen::Matrix2d curvature = kRidge * Eigen::Matrix2d::Identity();
    for (const Scored& one : scored_) {
      const Eigen::Vector2d features = inputs(one);
      const double p = logistic(x.dot(features));
      gradient += one.weight * (p - target(one)) * features;
      curvature += one.weight * p * (1.0 - p) * features * features.transpose();
    }
    const Eigen::Vector2d change = -curvature.inverse() * gradient;
    return {change, -gradient.dot(change)};
  }

  const Eigen::Vector2d& start() const { return start_; }
  double mean_target() const { return mean_target_; }

 private:
  static constexpr double kRidge = 1e-3;

  static Eigen::Vector2d inputs(const Scored& one) { return {one.value, 1.0}; }
  double target(const Scored& one) const { return one.positive ? target_positive_ : target_negative_; }

  std::span<const Scored> scored_;
  Eigen::Vector2d start_{PlattScaling{}.slope, PlattScaling{}.offset};
  double target_positive_ = 1.0;
  double target_negative_ = 0.0;
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

double PlattScaling::probability(double value) const {
  return logistic(std::clamp(slope * value + offset, -30.0, 30.0));
}

PlattScaling fit_platt(std::span<const Scored> scored) {
  constexpr std::size_t kFewest = 10;
  if (scored.size() < kFewest) {
    return {};
  }
  const Loss loss(scored);
  const Eigen::Vector2d x = minimum_of(loss);
  if (x[0] >= 0.0) {
    return {x[0], x[1]};
  }
  return {0.0, std::log(loss.mean_target() / (1.0 - loss.mean_target()))};
}

}  // namespace spincat
