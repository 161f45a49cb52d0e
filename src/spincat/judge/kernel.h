// The kernel: how alike two feature vectors are, as the judges see it.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "spincat/judge/gram.h"
#include "spincat/judge/settings.h"

namespace spincat {

// A kernel with what it has learned from training objects.
//
//   linear:  K(x, y) = x . y
//   rbf:     K(x, y) = mean over blocks b of exp(-|x_b - y_b|^2 / scale[b])
//
// where x_b are the consecutive block_sizes[b] features of block b. A block whose scale is 0 (all training objects are
// the same there) says nothing and counts as 1.
struct Kernel {
  KernelKind kind = KernelKind::linear;
  std::vector<std::uint32_t> block_sizes;  // rbf: of each block, all > 0; linear: empty
  std::vector<float> scale;                // rbf: of each block, >= 0; linear: empty

  // K of one feature vector with each row of `features`. Deterministic. Precondition: lengths match.
  Eigen::VectorXf row(const FeatureMatrix& features, std::span<const float> x) const;
};

// The kernel for training on the given rows of `features`: an rbf block's scale is the mean squared distance between
// two of them, over all ordered pairs, each row's with itself included. Rows that are not given do not matter.
// Deterministic. Preconditions: block sizes add up to the number of columns; there is a row.
Kernel fit_kernel(KernelKind kind, std::span<const std::uint32_t> block_sizes, const FeatureMatrix& features,
                  std::span<const std::uint32_t> rows);

// The inner products of all rows of a table, which every training on some of the rows picks from: one matrix for the
// linear kernel, one a block for rbf. Without any matrix: training computes what it needs (which takes longer, and may
// differ in the last bit).
struct GramMatrices {
  std::vector<Eigen::MatrixXf> blocks;
  bool empty() const { return blocks.empty(); }
};
// The columns of the features that each of its matrices is made of: first and count.
std::vector<std::pair<Eigen::Index, Eigen::Index>> gram_columns(KernelKind kind,
                                                                std::span<const std::uint32_t> block_sizes,
                                                                Eigen::Index columns);
GramMatrices make_shared_gram(KernelKind kind, std::span<const std::uint32_t> block_sizes,
                              const FeatureMatrix& features, int threads);

// K of all pairs of the given rows of `features`; `gram` is a GramMatrices of that kernel's kind for all rows, or
// empty. Deterministic.
Eigen::MatrixXf kernel_matrix(const Kernel& kernel, const FeatureMatrix& features, const GramMatrices& gram,
                              std::span<const std::uint32_t> rows);

// K of each of the rows `a` (a row of the result) with each of the rows `b`. Precondition: `gram` is not empty.
Eigen::MatrixXf kernel_between(const Kernel& kernel, const GramMatrices& gram, std::span<const std::uint32_t> a,
                               std::span<const std::uint32_t> b);

}  // namespace spincat
