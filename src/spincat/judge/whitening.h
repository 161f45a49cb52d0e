// The small space in which judges learn: objects of one category lie close in it, those of several far apart.
//
// Source: within-class covariance normalisation (A. O. Hatch, S. Kajarekar and A. Stolcke, Interspeech 2006), after a
// principal component analysis and with a share of the identity (J. H. Friedman, JASA 84, 1989).
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "spincat/judge/fixed_product.h"
#include "spincat/judge/gram.h"
#include "spincat/judge/half_rows.h"

namespace spincat {

// The way from D features to d numbers, as it is learned.
struct LearnedWhitening {
  FeatureMatrix map;          // d x D
  Eigen::RowVectorXf middle;  // d: where the mean of the training rows comes to
};

// The way from F features where the learned one begins with their coordinates along a basis (D x F); the same without
// rows.
LearnedWhitening after_basis(LearnedWhitening learned, const FeatureMatrix& basis);

// The same as judges are used with: numbers of the map are rounded to 16-bit floats, after map and middle were scaled
// alike so that the largest is 1. Without rows the judges see the features themselves.
struct Whitening {
  HalfRows columns;           // D x d: the map's
  Eigen::RowVectorXf middle;  // d

  Whitening() = default;
  explicit Whitening(LearnedWhitening learned);

  bool empty() const { return columns.rows() == 0; }
  std::size_t input_length() const { return columns.rows(); }
  std::size_t length() const { return columns.columns(); }

  // map x - middle, and the same scaled to length 1 (zeros where there is no length). Deterministic, also across
  // machines. Precondition: input_length() numbers.
  Eigen::RowVectorXf unscaled_place(std::span<const float> features) const;
  std::vector<float> place(std::span<const float> features) const;
};

// Places rows that are whitened but for the last two steps: less `middle`, scaled to length 1.
void finish_places(const Eigen::RowVectorXf& middle, FeatureMatrix& rows);

// What is learned from coordinates y (R x M) of training rows and the category of each: W such that W y - W mean is
// whitened. With C the covariance of the rows and C_w that about the means of their categories: P the d principal
// directions of C, S = P C_w P^T, S + 0.3 trace(S) / d I = L L^T, W = L^-1 P. trace(S) is taken for a ten-thousandth of
// trace(C) at least. (L^-1 is the inverse square root but for a turn, which no linear judge notices.)
struct WhitenedAxes {
  FeatureMatrix axes;         // d x M
  Eigen::RowVectorXf middle;  // d: W mean
};

// d is `dimensions` at most, and at most the number of directions in which the rows vary. Deterministic, also across
// machines. Preconditions: a row; a label for each.
WhitenedAxes learn_whitening(const FeatureMatrix& coordinates, std::span<const std::uint32_t> labels, int dimensions);

}  // namespace spincat
