#include "spincat/judge/kernel.h"

#include <cstddef>

namespace spincat {
namespace {

// Turns squared distances within a block into what the block adds to the kernel's sum.
template <class Distances>
auto similarity(const Distances& squared, float scale) {
  const float factor = scale > 0.0F ? -1.0F / scale : 0.0F;
  return (squared.array().max(0.0F) * factor).exp().matrix();
}

// The columns of each block: first and count.
std::vector<std::pair<Eigen::Index, Eigen::Index>> columns_of(std::span<const std::uint32_t> block_sizes) {
  std::vector<std::pair<Eigen::Index, Eigen::Index>> columns;
  Eigen::Index first = 0;
  for (const std::uint32_t size : block_sizes) {
    columns.emplace_back(first, size);
    first += size;
  }
  return columns;
}

Eigen::MatrixXf picked_gram(const FeatureMatrix& features, std::span<const std::uint32_t> rows, Eigen::Index first,
                            Eigen::Index count) {
  const FeatureMatrix part = features.middleCols(first, count)(rows, Eigen::all);
  return gram_matrix(part, 1);
}

}  // namespace

Eigen::VectorXf Kernel::row(const FeatureMatrix& features, std::span<const float> x) const {
  const Eigen::Map<const Eigen::RowVectorXf> given(x.data(), static_cast<Eigen::Index>(x.size()));
  Eigen::VectorXf result = Eigen::VectorXf::Zero(features.rows());
  if (kind == KernelKind::linear) {
    for (Eigen::Index i = 0; i < features.rows(); ++i) {
      result[i] = features.row(i).dot(given);
    }
    return result;
  }
  const auto columns = columns_of(block_sizes);
  for (std::size_t b = 0; b < columns.size(); ++b) {
    const auto [first, count] = columns[b];
    Eigen::VectorXf squared(features.rows());
    for (Eigen::Index i = 0; i < features.rows(); ++i) {
      squared[i] = (features.row(i).segment(first, count) - given.segment(first, count)).squaredNorm();
    }
    result += similarity(squared, scale[b]);
  }
  return result / static_cast<float>(columns.size());
}

Kernel fit_kernel(KernelKind kind, std::span<const std::uint32_t> block_sizes, const FeatureMatrix& features,
                  std::span<const std::uint32_t> rows) {
  Kernel kernel{kind, {}, {}};
  if (kind == KernelKind::linear) {
    return kernel;
  }
  // The mean of |x - y|^2 over all pairs is twice the mean of |x - mean|^2.
  Eigen::RowVectorXd mean = Eigen::RowVectorXd::Zero(features.cols());
  for (const std::uint32_t row : rows) {
    mean += features.row(row).cast<double>();
  }
  mean /= static_cast<double>(rows.size());
  kernel.block_sizes.assign(block_sizes.begin(), block_sizes.end());
  for (const auto& [first, count] : columns_of(block_sizes)) {
    double spread = 0.0;
    for (const std::uint32_t row : rows) {
      spread += (features.row(row).segment(first, count).cast<double>() - mean.segment(first, count)).squaredNorm();
    }
    kernel.scale.push_back(static_cast<float>(2.0 * spread / static_cast<double>(rows.size())));
  }
  return kernel;
}

std::vector<std::pair<Eigen::Index, Eigen::Index>> gram_columns(KernelKind kind,
                                                                std::span<const std::uint32_t> block_sizes,
                                                                Eigen::Index columns) {
  if (kind == KernelKind::linear) {
    return {{0, columns}};
  }
  return columns_of(block_sizes);
}

GramMatrices make_shared_gram(KernelKind kind, std::span<const std::uint32_t> block_sizes,
                              const FeatureMatrix& features, int threads) {
  GramMatrices gram;
  for (const auto& [first, count] : gram_columns(kind, block_sizes, features.cols())) {
    gram.blocks.push_back(gram_matrix(features.middleCols(first, count), threads));
  }
  return gram;
}

Eigen::MatrixXf kernel_matrix(const Kernel& kernel, const FeatureMatrix& features, const GramMatrices& gram,
                              std::span<const std::uint32_t> rows) {
  const auto products = [&](std::size_t block, Eigen::Index first, Eigen::Index count) -> Eigen::MatrixXf {
    return gram.empty() ? picked_gram(features, rows, first, count) : gram.blocks[block](rows, rows);
  };
  if (kernel.kind == KernelKind::linear) {
    return products(0, 0, features.cols());
  }
  const auto n = static_cast<Eigen::Index>(rows.size());
  const auto columns = columns_of(kernel.block_sizes);
  Eigen::MatrixXf sum = Eigen::MatrixXf::Zero(n, n);
  for (std::size_t b = 0; b < columns.size(); ++b) {
    const Eigen::MatrixXf g = products(b, columns[b].first, columns[b].second);
    const Eigen::VectorXf length = g.diagonal();
    const Eigen::MatrixXf squared = (-2.0F * g).colwise() + length;
    sum += similarity(squared.rowwise() + length.transpose(), kernel.scale[b]);
  }
  return sum / static_cast<float>(columns.size());
}

Eigen::MatrixXf kernel_between(const Kernel& kernel, const GramMatrices& gram, std::span<const std::uint32_t> a,
                               std::span<const std::uint32_t> b) {
  if (kernel.kind == KernelKind::linear) {
    return gram.blocks[0](a, b);
  }
  Eigen::MatrixXf sum = Eigen::MatrixXf::Zero(static_cast<Eigen::Index>(a.size()), static_cast<Eigen::Index>(b.size()));
  for (std::size_t block = 0; block < gram.blocks.size(); ++block) {
    const Eigen::VectorXf length = gram.blocks[block].diagonal();
    const Eigen::MatrixXf squared =
        (-2.0F * Eigen::MatrixXf(gram.blocks[block](a, b))).colwise() + Eigen::VectorXf(length(a));
    sum += similarity(squared.rowwise() + Eigen::RowVectorXf(length(b)), kernel.scale[block]);
  }
  return sum / static_cast<float>(gram.blocks.size());
}

}  // namespace spincat
