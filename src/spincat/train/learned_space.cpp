#include "spincat/train/learned_space.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "spincat/geometry/evenly_spread.h"
#include "spincat/geometry/parallel_for.h"
#include "spincat/judge/principal_directions.h"

namespace spincat {
namespace {

// Directions besides those of the space are followed, as those of a sample are not quite those of all rows.
constexpr int kMoreDirections = 56;

std::vector<std::uint32_t> labels_of(std::span<const std::uint32_t> labels, std::span<const std::uint32_t> rows) {
  std::vector<std::uint32_t> result;
  for (const std::uint32_t row : rows) {
    result.push_back(labels[row]);
  }
  return result;
}

// Inner products of all rows of the table with those of the sample: N x S.
FeatureMatrix products_with(const FeatureMatrix& features, const GramMatrices& gram,
                            std::span<const std::uint32_t> sample) {
  if (!gram.empty()) {
    return gram.blocks[0](Eigen::all, sample);
  }
  return product_with_transposed<float>(features, FeatureMatrix(features(sample, Eigen::all)));
}

}  // namespace

LearnedWhitening LearnedSpace::whitening(const FeatureMatrix& features) const {
  if (sample.empty()) {
    return {axes, middle};
  }
  FeatureMatrix map = FeatureMatrix::Zero(axes.rows(), features.cols());
  const std::span<const std::uint32_t> all(sample);
  for (std::size_t first = 0; first < all.size(); first += kDepth) {  // few rows at a time: all may be too much
    const auto some = all.subspan(first, std::min<std::size_t>(kDepth, all.size() - first));
    const FeatureMatrix weights =
        axes.middleCols(static_cast<Eigen::Index>(first), static_cast<Eigen::Index>(some.size())).transpose();
    map += transposed_product<float>(weights, FeatureMatrix(features(some, Eigen::all)));
  }
  return {std::move(map), middle};
}

bool learns_from_products(Eigen::Index columns, int dimensions) {
  return columns > dimensions + kMoreDirections;
}

Coordinates coordinates_of(const FeatureMatrix& rows, int dimensions, int threads) {
  const FeatureMatrix gram = gram_matrix(rows, threads);
  const FeatureMatrix directions = principal_directions(gram, dimensions + kMoreDirections);
  Coordinates result;
  result.coordinates = product_with_transposed<float>(gram, FeatureMatrix(directions.transpose()));
  result.basis.resize(directions.cols(), rows.cols());
  constexpr Eigen::Index kColumns = 512;  // of a thread's part
  parallel_for(static_cast<std::size_t>((rows.cols() + kColumns - 1) / kColumns), threads, [&](std::size_t part) {
    const Eigen::Index first = static_cast<Eigen::Index>(part) * kColumns;
    const Eigen::Index count = std::min(kColumns, rows.cols() - first);
    result.basis.middleCols(first, count) = transposed_product<float>(directions, rows.middleCols(first, count));
  });
  return result;
}

LearnedSpace learn_space(const FeatureMatrix& features, const GramMatrices& gram, std::span<const std::uint32_t> labels,
                         std::span<const std::uint32_t> rows, int dimensions) {
  const std::vector<std::uint32_t> their_labels = labels_of(labels, rows);
  LearnedSpace space;
  if (!learns_from_products(features.cols(), dimensions)) {
    WhitenedAxes learned = learn_whitening(features(rows, Eigen::all), their_labels, dimensions);
    space.axes = std::move(learned.axes);
    space.middle = std::move(learned.middle);
    space.places = product_with_transposed<float>(features, space.axes);
  } else {
    space.sample = evenly_spread(rows, kMostSampleRows);
    const FeatureMatrix products = products_with(features, gram, space.sample);
    const FeatureMatrix of_sample = products(space.sample, Eigen::all);
    const FeatureMatrix directions = principal_directions(of_sample, dimensions + kMoreDirections).transpose();
    const FeatureMatrix coordinates = product_with_transposed<float>(products(rows, Eigen::all).eval(), directions);
    WhitenedAxes learned = learn_whitening(coordinates, their_labels, dimensions);
    space.axes = transposed_product<float>(FeatureMatrix(learned.axes.transpose()), directions);
    space.middle = std::move(learned.middle);
    space.places = product_with_transposed<float>(products, space.axes);
  }
  finish_places(space.middle, space.places);
  return space;
}

}  // namespace spincat
