#include "spincat/judge/whitening.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <cstdint>
#include <vector>

#include "spincat/geometry/random.h"

namespace spincat {
namespace {

// Three categories apart along the first axis, each wide along the second and narrow along all others.
struct Categories {
  FeatureMatrix rows = FeatureMatrix(300, 6);
  std::vector<std::uint32_t> labels;

  Categories() {
    Random random(9);
    for (Eigen::Index i = 0; i < rows.rows(); ++i) {
      labels.push_back(static_cast<std::uint32_t>(i % 3));
      for (Eigen::Index d = 0; d < 6; ++d) {
        const double width = d == 1 ? 4.0 : 0.1;
        rows(i, d) = static_cast<float>(2.0 + width * random.normal() + (d == 0 ? static_cast<double>(i % 3) : 0.0));
      }
    }
  }
};

// The same by its definition: an inverse square root, everything in double precision.
Eigen::MatrixXd slow_whitened(const Categories& data, int dimensions) {
  Eigen::MatrixXd x = data.rows.cast<double>();
  x.rowwise() -= x.colwise().mean().eval();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> pca(x.transpose() * x);
  x = x * pca.eigenvectors().rightCols(dimensions);
  Eigen::MatrixXd within = Eigen::MatrixXd::Zero(dimensions, dimensions);
  for (std::uint32_t c = 0; c < 3; ++c) {
    std::vector<Eigen::Index> own;
    for (std::size_t i = 0; i < data.labels.size(); ++i) {
      if (data.labels[i] == c) {
        own.push_back(static_cast<Eigen::Index>(i));
      }
    }
    Eigen::MatrixXd rows = x(own, Eigen::all);
    rows.rowwise() -= rows.colwise().mean().eval();
    within += rows.transpose() * rows / static_cast<double>(x.rows());
  }
  within.diagonal().array() += 0.3 * within.trace() / dimensions;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> spread(within);
  return x * spread.operatorInverseSqrt();
}

TEST(Whitening, IsTheInverseSquareRootOfTheSpreadButForATurn) {
  const Categories data;
  for (const int dimensions : {2, 6}) {
    const WhitenedAxes learned = learn_whitening(data.rows, data.labels, dimensions);
    ASSERT_EQ(learned.axes.rows(), dimensions);
    Eigen::MatrixXf places = data.rows * learned.axes.transpose();
    places.rowwise() -= learned.middle;
    const Eigen::MatrixXd expected = slow_whitened(data, dimensions);
    // What no turn changes: all inner products.
    const Eigen::MatrixXd difference = (places * places.transpose()).cast<double>() - expected * expected.transpose();
    EXPECT_LT(difference.cwiseAbs().maxCoeff(), 1e-3 * (expected * expected.transpose()).cwiseAbs().maxCoeff());
  }
}

TEST(Whitening, PlacesObjectsOfOneCategoryClose) {
  const Categories data;
  const WhitenedAxes learned = learn_whitening(data.rows, data.labels, 6);
  const Whitening whitening({learned.axes, learned.middle});
  const auto place = [&](Eigen::Index i) {
    const std::vector<float> values = whitening.place({data.rows.row(i).data(), 6});
    return Eigen::VectorXf(Eigen::Map<const Eigen::VectorXf>(values.data(), 6));
  };
  const auto raw = [&](Eigen::Index i, Eigen::Index j) { return (data.rows.row(i) - data.rows.row(j)).norm(); };
  int nearer_before = 0;
  int nearer = 0;
  for (Eigen::Index i = 0; i + 5 < data.rows.rows(); i += 3) {  // row i + 3 is of the same category, i + 5 of the third
    EXPECT_NEAR(place(i).norm(), 1.0F, 1e-5F);
    nearer_before += raw(i, i + 3) < raw(i, i + 5) ? 1 : 0;
    nearer += (place(i) - place(i + 3)).norm() < (place(i) - place(i + 5)).norm() ? 1 : 0;
  }
  EXPECT_LT(nearer_before, 75);  // of 99
  EXPECT_GT(nearer, 90);
}

TEST(Whitening, RoundsItsMapToHalvesAndNothingElse) {
  FeatureMatrix map(1, 3);
  map << 2e9F, 1.0e9F / 3.0F, 0.0F;
  const Whitening whitening(LearnedWhitening{map, Eigen::RowVectorXf::Constant(1, 4e9F)});
  const std::vector<float> one = {1.0F};
  const std::vector<float> halves = whitening.columns.products(one);
  EXPECT_EQ(halves[0], 1.0F);
  EXPECT_NE(halves[1], 1.0F / 6.0F);
  EXPECT_NEAR(halves[1], 1.0F / 6.0F, 1e-4F);
  EXPECT_EQ(halves[2], 0.0F);
  EXPECT_EQ(whitening.middle[0], 2.0F);
}

TEST(Whitening, AfterABasisIsBothTogether) {
  const Categories data;
  const FeatureMatrix basis = FeatureMatrix::Random(6, 9);
  const FeatureMatrix map = data.rows.topRows(2);
  const LearnedWhitening both = after_basis({map, Eigen::RowVectorXf::Zero(2)}, basis);
  EXPECT_LT((both.map - map * basis).cwiseAbs().maxCoeff(), 1e-4F);
  EXPECT_EQ(after_basis({map, Eigen::RowVectorXf::Zero(2)}, {}).map, map);
}

TEST(Whitening, OfRowsThatAreAllTheSameHasNoLength) {
  const FeatureMatrix rows = FeatureMatrix::Ones(4, 3);
  const std::vector<std::uint32_t> labels = {0, 0, 1, 1};
  const WhitenedAxes learned = learn_whitening(rows, labels, 2);
  EXPECT_EQ(learned.axes.rows(), 0);
}

// One object a category: nothing is known of how objects of a category differ.
TEST(Whitening, OfSingleObjectsKeepsTheirDistances) {
  FeatureMatrix rows(3, 2);
  rows << 0, 0, 3, 0, 0, 4;
  const std::vector<std::uint32_t> labels = {0, 1, 2};
  const WhitenedAxes learned = learn_whitening(rows, labels, 2);
  ASSERT_EQ(learned.axes.rows(), 2);
  const Eigen::MatrixXf places = rows * learned.axes.transpose();
  const float side = (places.row(0) - places.row(1)).norm();
  EXPECT_NEAR((places.row(0) - places.row(2)).norm() / side, 4.0F / 3.0F, 1e-2F);
}

}  // namespace
}  // namespace spincat
