// One two-category support vector machine on a Gram matrix.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace spincat {

// What training finds: f(x) = bias + sum of coefficient[s] K(object[s], x); f > 0 speaks for the first category.
struct PairwiseSvm {
  std::vector<std::uint32_t> object;  // rows of the Gram matrix that became support vectors, ascending
  std::vector<double> coefficient;
  double bias = 0.0;
};

// Trains a C-SVM (libsvm, PRECOMPUTED) on a square Gram matrix whose first `first_count` rows are the objects of the
// first category and whose other rows are those of the second. `c_first` and `c_second` are the C of either side, > 0.
// Deterministic. Precondition: 0 < first_count < gram.rows(), finite entries.
PairwiseSvm train_pairwise_svm(const Eigen::MatrixXf& gram, std::uint32_t first_count, double c_first, double c_second);

}  // namespace spincat
