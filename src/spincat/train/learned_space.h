// The small space that the judges of one training learn in.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "spincat/judge/gram.h"
#include "spincat/judge/kernel.h"
#include "spincat/judge/whitening.h"

namespace spincat {

// What whitening.h says, learned from some rows of a table. Where these are shorter than their features are many, it is
// their inner products that are worked with.
struct LearnedSpace {
  FeatureMatrix places;               // N x d: all rows of the table in it, trained on or not
  std::vector<std::uint32_t> sample;  // rows of the table; none: `axes` are those of its columns
  FeatureMatrix axes;                 // d x S: as sums of the sample's rows, or d x D
  Eigen::RowVectorXf middle;          // d

  // The way of any features there. `features` are those that it was learned from.
  LearnedWhitening whitening(const FeatureMatrix& features) const;
};

// Any number of rows vary in the directions in which so many of them do; their square is worked with.
inline constexpr std::size_t kMostSampleRows = 1536;

// Rows as coordinates along the directions in which they vary most, some more than a space is to have dimensions.
struct Coordinates {
  FeatureMatrix basis;        // M x D
  FeatureMatrix coordinates;  // R x M
};
// The same for any number of threads.
Coordinates coordinates_of(const FeatureMatrix& rows, int dimensions, int threads);

// Whether a space is learned from inner products of rows, not from so many columns themselves.
bool learns_from_products(Eigen::Index columns, int dimensions);

// Learns a space of `dimensions` at most from the given rows and the labels of these alone. `gram` is that of all
// features, or empty. Deterministic. Precondition: there is a row.
LearnedSpace learn_space(const FeatureMatrix& features, const GramMatrices& gram, std::span<const std::uint32_t> labels,
                         std::span<const std::uint32_t> rows, int dimensions);

}  // namespace spincat
