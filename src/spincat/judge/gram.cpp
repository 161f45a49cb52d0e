#include "spincat/judge/gram.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace spincat {
namespace {

// Fixed, and small enough that Eigen does not cut a product further by the sizes of this machine's caches: the order in
// which an entry is summed must not depend on the machine.
constexpr Eigen::Index kTile = 64;
constexpr Eigen::Index kDepth = 128;

void fill_tile(const Eigen::Ref<const FeatureMatrix>& features, Eigen::Index i, Eigen::Index j, Eigen::MatrixXf& gram) {
  const Eigen::Index rows = std::min(kTile, features.rows() - i);
  const Eigen::Index columns = std::min(kTile, features.rows() - j);
  Eigen::MatrixXf tile = Eigen::MatrixXf::Zero(rows, columns);
  for (Eigen::Index d = 0; d < features.cols(); d += kDepth) {
    const Eigen::Index depth = std::min(kDepth, features.cols() - d);
    tile.noalias() += features.block(i, d, rows, depth) * features.block(j, d, columns, depth).transpose();
  }
  if (i == j) {  // a product's last bit may depend on its place in the tile
    tile.triangularView<Eigen::StrictlyUpper>() = tile.transpose().eval();
  }
  gram.block(i, j, rows, columns) = tile;
  gram.block(j, i, columns, rows) = tile.transpose();
}

}  // namespace

Eigen::MatrixXf gram_matrix(const Eigen::Ref<const FeatureMatrix>& features, int threads) {
  std::vector<std::pair<Eigen::Index, Eigen::Index>> tiles;
  for (Eigen::Index i = 0; i < features.rows(); i += kTile) {
    for (Eigen::Index j = 0; j <= i; j += kTile) {
      tiles.emplace_back(i, j);
    }
  }
  Eigen::MatrixXf gram(features.rows(), features.rows());
#pragma omp parallel for schedule(dynamic) num_threads(threads)
  for (std::size_t t = 0; t < tiles.size(); ++t) {
    fill_tile(features, tiles[t].first, tiles[t].second, gram);
  }
  return gram;
}

}  // namespace spincat
