#include "spincat/judge/whitening.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace spincat {
namespace {

constexpr double kShareOfIdentity = 0.3;  // of the mean variance within categories
constexpr double kLeastShare = 1e-6;      // of the largest variance: what is below is rounding
constexpr double kLeastSpread = 1e-4;     // of all variance: where categories have one row each, theirs is rounding

// Rows less their mean, which `mean` gets.
FeatureMatrix centred(const FeatureMatrix& rows, Eigen::RowVectorXd& mean) {
  mean = Eigen::RowVectorXd::Zero(rows.cols());
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    mean += rows.row(i).cast<double>();
  }
  mean /= static_cast<double>(rows.rows());
  return rows.rowwise() - mean.cast<float>();
}

// The covariance of the means of the categories, of rows whose mean is 0.
RowMajor<double> covariance_of_means(const FeatureMatrix& rows, std::span<const std::uint32_t> labels) {
  std::map<std::uint32_t, std::pair<double, Eigen::RowVectorXd>> sums;  // count and sum of each category
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    auto& [count, sum] = sums[labels[static_cast<std::size_t>(i)]];
    if (count == 0.0) {
      sum = Eigen::RowVectorXd::Zero(rows.cols());
    }
    count += 1.0;
    sum += rows.row(i).cast<double>();
  }
  RowMajor<double> weighed(static_cast<Eigen::Index>(sums.size()), rows.cols());
  Eigen::Index next = 0;
  for (const auto& [label, of] : sums) {
    weighed.row(next++) = of.second / std::sqrt(of.first * static_cast<double>(rows.rows()));
  }
  return transposed_product<double>(weighed, weighed);
}

// d x M: the directions of largest variance, the largest first.
RowMajor<double> largest_directions(const RowMajor<double>& covariance, int most) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(covariance);
  const Eigen::Index all = covariance.rows();
  const double least = std::max(kLeastShare * eigen.eigenvalues()[all - 1], 1e-30);
  Eigen::Index found = 0;
  while (found < std::min<Eigen::Index>(most, all) && eigen.eigenvalues()[all - 1 - found] > least) {
    ++found;
  }
  return eigen.eigenvectors().rightCols(found).rowwise().reverse().transpose();
}

}  // namespace

LearnedWhitening after_basis(LearnedWhitening learned, const FeatureMatrix& basis) {
  if (basis.rows() > 0) {
    const FeatureMatrix columns = learned.map.transpose();
    learned.map = transposed_product<float>(columns, basis);
  }
  return learned;
}

Whitening::Whitening(LearnedWhitening learned) {
  const float largest = learned.map.size() > 0 ? learned.map.cwiseAbs().maxCoeff() : 0.0F;
  const float factor = largest > 0.0F ? 1.0F / largest : 1.0F;
  learned.map *= factor;
  columns = HalfRows(learned.map);
  middle = learned.middle * factor;
}

Eigen::RowVectorXf Whitening::unscaled_place(std::span<const float> features) const {
  const std::vector<float> sums = columns.weighted_sum(features);
  return Eigen::Map<const Eigen::RowVectorXf>(sums.data(), middle.size()) - middle;
}

std::vector<float> Whitening::place(std::span<const float> features) const {
  Eigen::RowVectorXf place = unscaled_place(features);
  const float length = place.norm();
  if (length > 0.0F) {
    place /= length;
  }
  return {place.data(), place.data() + place.size()};
}

void finish_places(const Eigen::RowVectorXf& middle, FeatureMatrix& rows) {
  rows.rowwise() -= middle;
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    const float length = rows.row(i).norm();
    if (length > 0.0F) {
      rows.row(i) /= length;
    }
  }
}

WhitenedAxes learn_whitening(const FeatureMatrix& coordinates, std::span<const std::uint32_t> labels, int dimensions) {
  Eigen::RowVectorXd mean;
  const FeatureMatrix rows = centred(coordinates, mean);
  const RowMajor<double> all = transposed_product<float>(rows, rows).cast<double>() / static_cast<double>(rows.rows());
  const RowMajor<double> within = all - covariance_of_means(rows, labels);
  const RowMajor<double> principal = largest_directions(all, dimensions);
  const auto d = static_cast<double>(std::max<Eigen::Index>(principal.rows(), 1));
  RowMajor<double> spread =
      product_with_transposed<double>(product_with_transposed<double>(principal, within), principal);
  const double least = std::max(kLeastSpread * all.trace() / d, 1e-30);
  const double mean_spread = std::max(spread.trace() / d, least);
  spread.diagonal().array() += kShareOfIdentity * mean_spread;
  const Eigen::LLT<Eigen::MatrixXd> cholesky(spread);
  const Eigen::MatrixXd axes = cholesky.matrixL().solve(Eigen::MatrixXd(principal));
  return {axes.cast<float>(), (axes * mean.transpose()).transpose().cast<float>()};
}

}  // namespace spincat
