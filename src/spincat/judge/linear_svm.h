// One two-category support vector machine on short rows, without a Gram matrix: the square of the rows is nowhere.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "spincat/judge/gram.h"
#include "spincat/judge/pairwise_svm.h"

namespace spincat {

// The minimum over w and b of
//
//   (|w|^2 + b^2) / 2 + sum over i of C_i max(0, 1 - y_i (w . x_i + b))
//
// by dual coordinate descent with shrinking (Hsieh et al., A Dual Coordinate Descent Method for Large-scale Linear SVM,
// 2008, Algorithm 3), until no projected gradient differs from another by more than 0.01, or for 1,000 rounds at most.
// The first `first_count` rows are those of the first category (y = 1, C = c_first), the others those of the second.
// Time grows with the numbers that the rows hold, memory with the rows. Deterministic, also across machines.
// Precondition: 0 < first_count < rows.rows(), finite entries, prices > 0.
PairwiseSvm train_linear_svm(const FeatureMatrix& rows, std::uint32_t first_count, double c_first, double c_second);

}  // namespace spincat
