// One two-category support vector machine on a Gram matrix.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace spincat {

// What training finds: f(x) = bias + sum of coefficient[s] K(row[s], x); f > 0 speaks for the first category.
struct PairwiseSvm {
  std::vector<std::uint32_t> row;  // rows of the Gram matrix that became support vectors, ascending
  std::vector<double> coefficient;
  double bias = 0.0;
};

// Trains a C-SVM (libsvm, PRECOMPUTED) that tells the objects in `first` from those in `second`: rows of `gram`, not
// empty, disjoint. `c_first` and `c_second` are the C of either side, > 0. Deterministic.
PairwiseSvm train_pairwise_svm(const Eigen::MatrixXf& gram, std::span<const std::uint32_t> first,
                               std::span<const std::uint32_t> second, double c_first, double c_second);

}  // namespace spincat
