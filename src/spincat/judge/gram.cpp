#include "spincat/judge/gram.h"

#include <algorithm>

#include "spincat/geometry/parallel_for.h"
#include "spincat/judge/fixed_product.h"

namespace spincat {
namespace {

Eigen::MatrixXf tile_of(const Eigen::Ref<const FeatureMatrix>& features, Eigen::Index i, Eigen::Index j) {
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
  return tile;
}

}  // namespace

Eigen::MatrixXf gram_matrix(const Eigen::Ref<const FeatureMatrix>& features, int threads) {
  Eigen::MatrixXf gram(features.rows(), features.rows());
  const std::size_t strips = gram_strips(features.rows());
  parallel_for(strips, threads, [&](std::size_t s) {
    const std::size_t strip = strips - 1 - s;  // the longest first
    put_gram_strip(gram_strip(features, strip), strip, gram);
  });
  return gram;
}

std::size_t gram_strips(Eigen::Index rows) {
  return static_cast<std::size_t>((rows + kTile - 1) / kTile);
}

Eigen::MatrixXf gram_strip(const Eigen::Ref<const FeatureMatrix>& features, std::size_t strip) {
  const Eigen::Index i = static_cast<Eigen::Index>(strip) * kTile;
  const Eigen::Index rows = std::min(kTile, features.rows() - i);
  Eigen::MatrixXf part(rows, i + rows);
  for (Eigen::Index j = 0; j <= i; j += kTile) {
    part.middleCols(j, std::min(kTile, features.rows() - j)) = tile_of(features, i, j);
  }
  return part;
}

void put_gram_strip(const Eigen::Ref<const Eigen::MatrixXf>& part, std::size_t strip, Eigen::MatrixXf& gram) {
  const Eigen::Index i = static_cast<Eigen::Index>(strip) * kTile;
  gram.block(i, 0, part.rows(), part.cols()) = part;
  gram.block(0, i, part.cols(), part.rows()) = part.transpose();
}

}  // namespace spincat
