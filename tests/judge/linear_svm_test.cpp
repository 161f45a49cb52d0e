#include "spincat/judge/linear_svm.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "spincat/geometry/random.h"

namespace spincat {
namespace {

constexpr double kSolved = 0.02;  // it stops at 0.01

struct Plane {
  Eigen::RowVectorXd w;
  double bias = 0.0;
};

Plane plane_of(const FeatureMatrix& rows, const PairwiseSvm& svm) {
  Plane plane{Eigen::RowVectorXd::Zero(rows.cols()), svm.bias};
  for (std::size_t s = 0; s < svm.object.size(); ++s) {
    plane.w += svm.coefficient[s] * rows.row(svm.object[s]).cast<double>();
  }
  return plane;
}

// Two clouds of rows that overlap.
FeatureMatrix two_clouds(Eigen::Index first, Eigen::Index second, Eigen::Index columns) {
  Random random(7);
  FeatureMatrix rows(first + second, columns);
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    for (Eigen::Index d = 0; d < columns; ++d) {
      rows(i, d) = static_cast<float>(random.normal() + (d == 0 ? (i < first ? 1.0 : -1.0) : 0.0));
    }
  }
  return rows;
}

// The objective of linear_svm.h.
double objective(const FeatureMatrix& rows, std::uint32_t first_count, const Plane& plane, double c_first,
                 double c_second) {
  double sum = 0.5 * (plane.w.squaredNorm() + plane.bias * plane.bias);
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    const bool is_first = i < static_cast<Eigen::Index>(first_count);
    const double margin = plane.w.dot(rows.row(i).cast<double>()) + plane.bias;
    sum += (is_first ? c_first : c_second) * std::max(0.0, 1.0 - (is_first ? margin : -margin));
  }
  return sum;
}

// The same minimum, slowly: subgradient steps on w and b, ever smaller ones; the best of them all.
double least_objective_by_subgradients(const FeatureMatrix& rows, std::uint32_t first_count, double c_first,
                                       double c_second) {
  Plane plane{Eigen::RowVectorXd::Zero(rows.cols()), 0.0};
  double least = objective(rows, first_count, plane, c_first, c_second);
  for (int step = 1; step <= 20'000; ++step) {
    Plane slope = plane;
    for (Eigen::Index i = 0; i < rows.rows(); ++i) {
      const bool is_first = i < static_cast<Eigen::Index>(first_count);
      const double sign = is_first ? 1.0 : -1.0;
      if (sign * (plane.w.dot(rows.row(i).cast<double>()) + plane.bias) < 1.0) {
        const double pull = sign * (is_first ? c_first : c_second);
        slope.w -= pull * rows.row(i).cast<double>();
        slope.bias -= pull;
      }
    }
    plane.w -= slope.w / step;  // the objective is 1-strongly convex
    plane.bias -= slope.bias / step;
    least = std::min(least, objective(rows, first_count, plane, c_first, c_second));
  }
  return least;
}

TEST(LinearSvm, FindsTheWidestMarginOnALine) {
  // Of all (w, b) with 3 w + b >= 1 and -w + b <= -1 the shortest: w = 1/2, b = -1/2.
  FeatureMatrix x(5, 1);
  x << 5, 3, 8, -1, -4;
  const PairwiseSvm svm = train_linear_svm(x, 3, 100.0, 100.0);
  const Plane line = plane_of(x, svm);
  EXPECT_NEAR(line.w[0], 0.5, kSolved);
  EXPECT_NEAR(line.bias, -0.5, kSolved);
  EXPECT_EQ(svm.object, (std::vector<std::uint32_t>{1, 3}));
}

TEST(LinearSvm, TheCheaperSideGivesWay) {
  FeatureMatrix x(5, 1);
  x << 1, 1, 1, 1, -1;  // 1 is claimed by both sides, three times by the second
  const Plane dear_first = plane_of(x, train_linear_svm(x, 1, 1000.0, 100.0));
  EXPECT_NEAR(dear_first.w[0] + dear_first.bias, 1.0, kSolved);
  const Plane cheap_first = plane_of(x, train_linear_svm(x, 1, 100.0, 100.0));
  EXPECT_NEAR(cheap_first.w[0] + cheap_first.bias, -1.0, kSolved);
}

TEST(LinearSvm, ReachesTheMinimum) {
  for (const auto& [c_first, c_second] : {std::pair(0.1, 0.1), std::pair(1.0, 0.2)}) {
    const FeatureMatrix rows = two_clouds(20, 31, 4);
    const Plane plane = plane_of(rows, train_linear_svm(rows, 20, c_first, c_second));
    const double found = objective(rows, 20, plane, c_first, c_second);
    const double least = least_objective_by_subgradients(rows, 20, c_first, c_second);
    EXPECT_NEAR(found, least, 2e-3 * least);
  }
}

// What the optimum is known by: rows beyond the margin have no weight, those within it all that they may have.
TEST(LinearSvm, WeighsEachRowByItsSideOfTheMargin) {
  const FeatureMatrix rows = two_clouds(300, 200, 12);
  const PairwiseSvm svm = train_linear_svm(rows, 300, 0.3, 0.5);
  const Plane plane = plane_of(rows, svm);
  std::vector<double> alpha(500, 0.0);
  for (std::size_t s = 0; s < svm.object.size(); ++s) {
    alpha[svm.object[s]] = std::abs(svm.coefficient[s]);
    EXPECT_EQ(svm.coefficient[s] > 0.0, svm.object[s] < 300);
  }
  EXPECT_TRUE(std::ranges::is_sorted(svm.object));
  for (std::size_t i = 0; i < 500; ++i) {
    const double sign = i < 300 ? 1.0 : -1.0;
    const double margin = sign * (plane.w.dot(rows.row(static_cast<Eigen::Index>(i)).cast<double>()) + plane.bias);
    if (margin > 1.0 + kSolved) {
      EXPECT_EQ(alpha[i], 0.0);
    } else if (margin < 1.0 - kSolved) {
      EXPECT_EQ(alpha[i], i < 300 ? 0.3 : 0.5);
    }
  }
}

TEST(LinearSvm, SwappingTheCategoriesFlipsTheSign) {
  const FeatureMatrix rows = two_clouds(30, 30, 5);
  FeatureMatrix swapped(60, 5);
  swapped << rows.bottomRows(30), rows.topRows(30);
  const Plane plane = plane_of(rows, train_linear_svm(rows, 30, 1.0, 1.0));
  const Plane other = plane_of(swapped, train_linear_svm(swapped, 30, 1.0, 1.0));
  EXPECT_LT((plane.w + other.w).norm(), 0.02 * plane.w.norm());
  EXPECT_NEAR(plane.bias, -other.bias, 0.02);
}

TEST(LinearSvm, EndsForRowsThatNoPlaneParts) {
  const FeatureMatrix rows = FeatureMatrix::Ones(40, 3);
  const Plane plane = plane_of(rows, train_linear_svm(rows, 30, 1e4, 1e4));
  EXPECT_NEAR(plane.w.sum() + plane.bias, 1.0, kSolved);
  const PairwiseSvm of_nothing = train_linear_svm(FeatureMatrix::Zero(4, 3), 2, 1.0, 1.0);
  EXPECT_NEAR(of_nothing.bias, 0.0, kSolved);
}

}  // namespace
}  // namespace spincat
