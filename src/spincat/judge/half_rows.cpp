// Compiled once for each instruction set, as spin/kernel.cpp; the best one that the machine has is chosen at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "spincat/judge/half_rows.cpp"
#include <hwy/foreach_target.h>
// after foreach_target.h
#include <hwy/highway.h>

#include "spincat/judge/half_rows.h"

HWY_BEFORE_NAMESPACE();
namespace spincat::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// sums[c] += weight * row[c]
void add_row(float weight, const std::uint16_t* row, float* sums, std::size_t columns) {
  const hn::ScalableTag<float> wide;
  const hn::Rebind<hwy::float16_t, decltype(wide)> narrow;
  const auto factor = hn::Set(wide, weight);
  const auto* halves = reinterpret_cast<const hwy::float16_t*>(row);
  std::size_t c = 0;
  for (; c + hn::Lanes(wide) <= columns; c += hn::Lanes(wide)) {
    const auto numbers = hn::PromoteTo(wide, hn::LoadU(narrow, halves + c));
    hn::StoreU(hn::Add(hn::LoadU(wide, sums + c), hn::Mul(factor, numbers)), wide, sums + c);
  }
  const hn::CappedTag<float, 1> one;
  const hn::Rebind<hwy::float16_t, decltype(one)> one_narrow;
  for (; c < columns; ++c) {
    sums[c] += weight * hn::GetLane(hn::PromoteTo(one, hn::LoadU(one_narrow, halves + c)));
  }
}

void add_rows(const float* weights, const std::uint16_t* rows, std::size_t count, std::size_t columns, float* sums) {
  for (std::size_t r = 0; r < count; ++r) {
    if (weights[r] != 0.0F) {  // many bins of spin images are empty
      add_row(weights[r], rows + r * columns, sums, columns);
    }
  }
}

void to_floats(const std::uint16_t* halves, std::size_t count, float* numbers) {
  const hn::CappedTag<float, 1> one;
  const hn::Rebind<hwy::float16_t, decltype(one)> narrow;
  for (std::size_t i = 0; i < count; ++i) {
    numbers[i] =
        hn::GetLane(hn::PromoteTo(one, hn::LoadU(narrow, reinterpret_cast<const hwy::float16_t*>(halves) + i)));
  }
}

}  // namespace spincat::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace spincat {
namespace {

HWY_EXPORT(add_rows);
HWY_EXPORT(to_floats);

}  // namespace

HalfRows::HalfRows(const FeatureMatrix& transposed) : rows_(static_cast<std::size_t>(transposed.cols())) {
  bits_.reserve(static_cast<std::size_t>(transposed.size()));
  for (Eigen::Index r = 0; r < transposed.cols(); ++r) {
    for (Eigen::Index c = 0; c < transposed.rows(); ++c) {
      bits_.push_back(Eigen::half(transposed(c, r)).x);
    }
  }
}

std::vector<float> HalfRows::weighted_sum(std::span<const float> weights) const {
  std::vector<float> sums(columns(), 0.0F);
  HWY_DYNAMIC_DISPATCH(add_rows)(weights.data(), bits_.data(), rows_, columns(), sums.data());
  return sums;
}

std::vector<float> HalfRows::products(std::span<const float> weights) const {
  std::vector<float> numbers(columns());
  std::vector<float> result;
  result.reserve(rows_);
  for (std::size_t r = 0; r < rows_; ++r) {
    HWY_DYNAMIC_DISPATCH(to_floats)(bits_.data() + r * columns(), columns(), numbers.data());
    float sum = 0.0F;
    for (std::size_t c = 0; c < numbers.size(); ++c) {
      sum += weights[c] * numbers[c];
    }
    result.push_back(sum);
  }
  return result;
}

}  // namespace spincat
#endif
