#include "spincat/judge/principal_directions.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "spincat/geometry/random.h"

namespace spincat {
namespace {

constexpr std::uint64_t kStart = 0x5eed;    // any will do: the result hardly depends on it
constexpr Eigen::Index kMoreThanAsked = 8;  // directions that are followed besides, so that the last ones are good, too
constexpr int kRounds = 4;
constexpr double kLeastShare = 1e-6;  // of the largest variance: what is below is rounding

// Inner products of the vectors less their mean.
RowMajor<float> centred(const Eigen::Ref<const RowMajor<float>>& gram) {
  const Eigen::VectorXd means = gram.cast<double>().rowwise().mean();
  RowMajor<float> result(gram.rows(), gram.cols());
  for (Eigen::Index i = 0; i < gram.rows(); ++i) {
    for (Eigen::Index j = 0; j < gram.cols(); ++j) {
      result(i, j) = static_cast<float>(static_cast<double>(gram(i, j)) - means[i] - means[j] + means.mean());
    }
  }
  return result;
}

RowMajor<float> random_start(Eigen::Index rows, Eigen::Index columns) {
  Random random(kStart);
  RowMajor<float> start(rows, columns);
  for (float& value : start.reshaped()) {
    value = static_cast<float>(random.normal());
  }
  return start;
}

// Columns of length 1 at right angles that span the same space; directions that are none stay as good as zero.
RowMajor<double> orthogonal(RowMajor<double> columns) {
  for (int twice = 0; twice < 2; ++twice) {  // once is not exact where columns are nearly parallel
    const Eigen::VectorXd lengths = columns.colwise().norm().cwiseMax(1e-300);
    columns = (columns.array().rowwise() / lengths.transpose().array()).matrix().eval();
    Eigen::MatrixXd products = transposed_product<double>(columns, columns);
    products.diagonal().array() += 1e-12;
    const Eigen::LLT<Eigen::MatrixXd> cholesky(products);
    const Eigen::MatrixXd inverse = cholesky.matrixL().solve(Eigen::MatrixXd::Identity(columns.cols(), columns.cols()));
    columns = product_with_transposed<double>(columns, RowMajor<double>(inverse));
  }
  return columns;
}

RowMajor<double> product(const RowMajor<float>& symmetric, const RowMajor<double>& columns) {
  const RowMajor<float> transposed = columns.cast<float>().transpose();
  return product_with_transposed<float>(symmetric, transposed).cast<double>();
}

}  // namespace

RowMajor<float> principal_directions(const Eigen::Ref<const RowMajor<float>>& gram, Eigen::Index most) {
  const RowMajor<float> products = centred(gram);
  const Eigen::Index followed = std::min(most + kMoreThanAsked, gram.rows());
  RowMajor<double> space = orthogonal(random_start(gram.rows(), followed).cast<double>());
  for (int round = 1; round < kRounds; ++round) {
    space = orthogonal(product(products, space));
  }
  const RowMajor<double> image = product(products, space);
  const Eigen::MatrixXd small = transposed_product<double>(space, image);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen((small + small.transpose()) / 2.0);
  const Eigen::VectorXd& variances = eigen.eigenvalues();  // ascending
  const double least = kLeastShare * variances[followed - 1];
  Eigen::Index found = 0;
  while (found < std::min(most, followed) && variances[followed - 1 - found] > std::max(least, 0.0)) {
    ++found;
  }
  RowMajor<double> turned(found, followed);
  for (Eigen::Index m = 0; m < found; ++m) {
    turned.row(m) = eigen.eigenvectors().col(followed - 1 - m).transpose() / std::sqrt(variances[followed - 1 - m]);
  }
  RowMajor<double> result = product_with_transposed<double>(space, turned);
  result.rowwise() -= result.colwise().mean().eval();
  return result.cast<float>();
}

}  // namespace spincat
