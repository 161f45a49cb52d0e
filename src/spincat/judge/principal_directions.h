// The directions in which feature vectors vary most, found through their inner products: with some thousand vectors of
// ten thousand numbers the covariance would be the larger matrix.
//
// Source: N. Halko, P.-G. Martinsson and J. A. Tropp, "Finding structure with randomness", SIAM Review 53, 2011
// (subspace iteration, algorithm 4.4, and the eigenvalues of the small matrix as in 5.3).
#pragma once

#include <Eigen/Core>

#include "spincat/judge/fixed_product.h"

namespace spincat {

// At most so many orthogonal directions in which the S vectors with these inner products vary most about their mean.
// Column m of the result (S x M) holds the coefficients of a sum of the vectors that is direction m, of length 1; the
// coefficients of a column add up to 0. A vector x has the coordinates sum over s of result(s, m) (x . x_s), up to a
// constant for each m. Fewer where the vectors vary in fewer. Deterministic, also across machines.
// Precondition: `gram` is symmetric.
RowMajor<float> principal_directions(const Eigen::Ref<const RowMajor<float>>& gram, Eigen::Index most);

}  // namespace spincat
