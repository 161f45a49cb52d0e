// Gram matrices: all inner products of a set of feature vectors, which every judge's training shares.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>

#include "spincat/encode/feature_vector.h"

namespace spincat {

// One feature vector a row.
using FeatureMatrix = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// K(i, j) = x_i . x_j, symmetric, in single precision. Computed once for all judges: retraining on any subset of the
// rows (each pair of categories, each split) only picks entries. The same bytes for any number of threads: tiles of a
// fixed size, each summed in one order.
Eigen::MatrixXf gram_matrix(const Eigen::Ref<const FeatureMatrix>& features, int threads);

// The same in pieces, for whoever shares them out: strips of rows, the left part of each up to the diagonal.
std::size_t gram_strips(Eigen::Index rows);
Eigen::MatrixXf gram_strip(const Eigen::Ref<const FeatureMatrix>& features, std::size_t strip);
// Puts a strip into the matrix, and what is below the diagonal above it, too.
void put_gram_strip(const Eigen::Ref<const Eigen::MatrixXf>& part, std::size_t strip, Eigen::MatrixXf& gram);

}  // namespace spincat
