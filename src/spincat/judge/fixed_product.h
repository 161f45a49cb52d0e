// Matrix products whose bytes do not depend on the machine.
//
// Eigen cuts long products by the sizes of this machine's caches, and with them the order in which an entry is summed.
// Here products are made of tiles too small to be cut further.
#pragma once

#include <Eigen/Core>
#include <algorithm>

namespace spincat {

inline constexpr Eigen::Index kTile = 64;    // rows and columns of a tile
inline constexpr Eigen::Index kDepth = 128;  // products that are summed before they are added to the tile

template <class Scalar>
using RowMajor = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// a b^T: every row of `a` with every row of `b`. Deterministic, also across machines. Precondition: as many columns.
template <class Scalar>
RowMajor<Scalar> product_with_transposed(const Eigen::Ref<const RowMajor<Scalar>>& a,
                                         const Eigen::Ref<const RowMajor<Scalar>>& b) {
  RowMajor<Scalar> result = RowMajor<Scalar>::Zero(a.rows(), b.rows());
  for (Eigen::Index i = 0; i < a.rows(); i += kTile) {
    const Eigen::Index rows = std::min(kTile, a.rows() - i);
    for (Eigen::Index j = 0; j < b.rows(); j += kTile) {
      const Eigen::Index columns = std::min(kTile, b.rows() - j);
      for (Eigen::Index d = 0; d < a.cols(); d += kDepth) {
        const Eigen::Index depth = std::min(kDepth, a.cols() - d);
        result.block(i, j, rows, columns).noalias() +=
            a.block(i, d, rows, depth) * b.block(j, d, columns, depth).transpose();
      }
    }
  }
  return result;
}

// a^T b: every column of `a` with every column of `b`. The same promises. Precondition: as many rows.
template <class Scalar>
RowMajor<Scalar> transposed_product(const Eigen::Ref<const RowMajor<Scalar>>& a,
                                    const Eigen::Ref<const RowMajor<Scalar>>& b) {
  RowMajor<Scalar> result = RowMajor<Scalar>::Zero(a.cols(), b.cols());
  for (Eigen::Index d = 0; d < a.rows(); d += kDepth) {
    const Eigen::Index depth = std::min(kDepth, a.rows() - d);
    for (Eigen::Index i = 0; i < a.cols(); i += kTile) {
      const Eigen::Index rows = std::min(kTile, a.cols() - i);
      for (Eigen::Index j = 0; j < b.cols(); j += kTile) {
        const Eigen::Index columns = std::min(kTile, b.cols() - j);
        result.block(i, j, rows, columns).noalias() +=
            a.block(d, i, depth, rows).transpose() * b.block(d, j, depth, columns);
      }
    }
  }
  return result;
}

}  // namespace spincat
