// Gram matrices: all inner products of a set of feature vectors, which every judge's training shares.
#pragma once

#include <Eigen/Core>
#include <span>

#include "spincat/encode/feature_vector.h"

namespace spincat {

// One feature vector a row.
using FeatureMatrix = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// K(i, j) = x_i . x_j, symmetric, in single precision. Computed once for all judges: retraining on any subset of the
// rows (each pair of categories, each split) only picks entries. The same bytes for any number of threads: tiles of a
// fixed size, each summed in one order.
Eigen::MatrixXf gram_matrix(const Eigen::Ref<const FeatureMatrix>& features, int threads);

}  // namespace spincat
