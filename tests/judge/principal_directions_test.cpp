#include "spincat/judge/principal_directions.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <numeric>
#include <vector>

#include "spincat/geometry/random.h"

namespace spincat {
namespace {

// Vectors whose variance falls from axis to axis, about a mean far from 0.
RowMajor<float> falling_vectors(Eigen::Index rows, Eigen::Index length) {
  Random random(3);
  RowMajor<float> vectors(rows, length);
  for (Eigen::Index i = 0; i < rows; ++i) {
    for (Eigen::Index d = 0; d < length; ++d) {
      vectors(i, d) = static_cast<float>(1.0 + random.normal() / (1.0 + static_cast<double>(d)));
    }
  }
  return vectors;
}

Eigen::VectorXd variances_of(const RowMajor<float>& vectors) {
  const Eigen::MatrixXd rows = vectors.cast<double>();
  const Eigen::MatrixXd centred = rows.rowwise() - rows.colwise().mean();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(centred.transpose() * centred);
  return eigen.eigenvalues().reverse();
}

RowMajor<float> gram_of(const RowMajor<float>& vectors) {
  return product_with_transposed<float>(vectors, vectors);
}

TEST(PrincipalDirections, AreThoseOfTheCovariance) {
  const RowMajor<float> vectors = falling_vectors(90, 40);
  const RowMajor<float> found = principal_directions(gram_of(vectors), 5);
  ASSERT_EQ(found.cols(), 5);
  const Eigen::MatrixXf directions = found.transpose() * vectors;  // 5 x 40
  EXPECT_LT((directions * directions.transpose() - Eigen::MatrixXf::Identity(5, 5)).cwiseAbs().maxCoeff(), 1e-3F);
  const Eigen::VectorXd variances = variances_of(vectors);
  const Eigen::MatrixXf centred = vectors.rowwise() - vectors.colwise().mean();
  for (Eigen::Index m = 0; m < 5; ++m) {
    const double along = static_cast<double>((centred * directions.row(m).transpose()).squaredNorm());
    EXPECT_NEAR(along / variances[m], 1.0, 1e-2) << m;
  }
}

TEST(PrincipalDirections, GiveCoordinatesFromInnerProductsAlone) {
  const RowMajor<float> vectors = falling_vectors(30, 12);
  const RowMajor<float> found = principal_directions(gram_of(vectors), 4);
  const Eigen::MatrixXf by_products = gram_of(vectors) * found;
  const Eigen::MatrixXf by_directions = vectors * (found.transpose() * vectors).transpose();
  EXPECT_LT((by_products - by_directions).cwiseAbs().maxCoeff(), 1e-3F);
  EXPECT_LT(found.colwise().sum().cwiseAbs().maxCoeff(), 1e-4F);  // the mean counts for nothing
}

TEST(PrincipalDirections, AreNoMoreThanThereAre) {
  RowMajor<float> vectors = RowMajor<float>::Zero(20, 10);
  vectors.leftCols(3) = falling_vectors(20, 3);
  EXPECT_EQ(principal_directions(gram_of(vectors), 8).cols(), 3);
  EXPECT_EQ(principal_directions(gram_of(falling_vectors(4, 10)), 8).cols(), 3);  // four points span three directions
  EXPECT_EQ(principal_directions(gram_of(RowMajor<float>::Ones(5, 10)), 8).cols(), 0);
}

}  // namespace
}  // namespace spincat
