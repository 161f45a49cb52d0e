// A long matrix of 16-bit floats, made to be multiplied by a vector: what an object's features are brought to a small
// space by. Half the memory is half the time, as every number is used once.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "spincat/judge/gram.h"

namespace spincat {

class HalfRows {
 public:
  HalfRows() = default;
  // The transposed matrix, each number rounded to the nearest 16-bit float. Precondition: below 65,504 in size.
  explicit HalfRows(const FeatureMatrix& transposed);
  // `rows` rows of as many numbers as `bits` has for each, row by row as IEEE 754 has them (binary16).
  HalfRows(std::size_t rows, std::vector<std::uint16_t> bits) : rows_(rows), bits_(std::move(bits)) {}

  std::size_t rows() const { return rows_; }
  std::size_t columns() const { return rows_ > 0 ? bits_.size() / rows_ : 0; }
  std::span<const std::uint16_t> bits() const { return bits_; }
  bool all_finite() const {
    constexpr std::uint16_t kExponent = 0x7C00;  // all of its bits are set in what is no finite number
    return std::ranges::none_of(bits_, [](std::uint16_t half) { return (half & kExponent) == kExponent; });
  }

  // The sum over all rows r of weights[r] row r. Every number is summed in the order of the rows, by single-precision
  // operations without fused ones: the same bytes on every machine. Precondition: rows() weights.
  std::vector<float> weighted_sum(std::span<const float> weights) const;

  // weights . row r for every row r. The same promises. Precondition: columns() weights.
  std::vector<float> products(std::span<const float> weights) const;

 private:
  std::size_t rows_ = 0;
  std::vector<std::uint16_t> bits_;
};

}  // namespace spincat
