// Private to spin/kernel.cpp: from the sums to the image.
//
// Included anew for each instruction set, hence the guard that toggles.
#if defined(SPINCAT_SPIN_KERNEL_IMAGE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SPINCAT_SPIN_KERNEL_IMAGE_INL_H
#undef SPINCAT_SPIN_KERNEL_IMAGE_INL_H
#else
#define SPINCAT_SPIN_KERNEL_IMAGE_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "spincat/spin/kernel.h"
#include "spincat/spin/kernel_vectors-inl.h"
#include "spincat/spin/support.h"

HWY_BEFORE_NAMESPACE();
namespace spincat::HWY_NAMESPACE {
namespace {

using L = hn::ScalableTag<std::int64_t>;
using D = hn::RebindToFloat<L>;
using VL = hn::Vec<L>;

// Sums as values of an image, rounded to double and then to float; below zero (by a rounding of u v) as zero. Writes a
// whole vector.
HWY_INLINE void write_values(VL sums, double factor, float* values) {
  const D d;
  const hn::Rebind<float, D> narrow;
  const auto positive = hn::Max(hn::ConvertTo(d, sums), hn::Zero(d));
  hn::StoreU(hn::DemoteTo(narrow, hn::Mul(positive, hn::Set(d, factor))), narrow, values);
}

// The shares that the cells of one row give to their four neighbours, as running arrays with a zero on the left.
struct RowShares {
  static constexpr std::size_t kLeft = 8;  // so that loads at a column, not one to its left, are aligned
  static constexpr std::size_t kRoom = kLeft + 512 + 16;

  alignas(64) std::int64_t here[kRoom];   // (1 - u)(1 - v)
  alignas(64) std::int64_t right[kRoom];  // (1 - u) v
  alignas(64) std::int64_t below[kRoom];  // u (1 - v)
  alignas(64) std::int64_t both[kRoom];   // u v

  // All zero, to the left and to the right of `columns` columns, too.
  void clear(std::size_t columns) {
    for (std::int64_t* shares : {here, right, below, both}) {
      std::fill_n(shares, kLeft + columns + 16, 0);
    }
  }
};

// The sums of the moments 1, u, v, uv of a vector of cells.
struct Moments {
  VL one, u, v, uv;
};

// Those of plain sums. What in_units adds, times the number of points, is 127 times `one`.
HWY_INLINE Moments plain_moments(const std::int64_t* sums) {
  VL one, u, v, uv;
  hn::LoadInterleaved4(L(), sums, one, u, v, uv);
  const VL bias = hn::Sub(hn::ShiftLeft<7>(one), one);
  return {one, hn::Sub(u, bias), hn::Sub(v, bias), hn::Sub(uv, bias)};
}

// Those of weighted sums, given the plain ones of the same cells.
HWY_INLINE Moments weighted_moments(const std::int64_t* sums, const Moments& plain) {
  VL one, u, v, uv;
  hn::LoadInterleaved4(L(), sums, one, u, v, uv);
  const VL bias = hn::Sub(hn::ShiftLeft<7>(plain.one), plain.one);
  return {hn::Sub(one, bias), hn::Sub(u, bias), hn::Sub(v, bias), hn::Sub(uv, bias)};
}

HWY_INLINE Moments difference(const Moments& a, const Moments& b) {
  return {hn::Sub(a.one, b.one), hn::Sub(a.u, b.u), hn::Sub(a.v, b.v), hn::Sub(a.uv, b.uv)};
}

// What a channel of the image is made of.
enum class Channel { plain, weighted, rest };  // rest = plain - weighted

template <Channel kChannel>
HWY_INLINE void split_row(const std::int64_t* sums, std::size_t plane_stride, std::size_t columns, RowShares& row) {
  const L l;
  for (std::size_t j = 0; j < columns; j += hn::Lanes(l)) {
    Moments m = plain_moments(sums + 4 * j);
    if constexpr (kChannel != Channel::plain) {
      const Moments weighted = weighted_moments(sums + plane_stride + 4 * j, m);
      m = kChannel == Channel::weighted ? weighted : difference(m, weighted);
    }
    const VL u_only = hn::Sub(m.u, m.uv);
    const VL v_only = hn::Sub(m.v, m.uv);
    const std::size_t at = RowShares::kLeft + j;
    hn::Store(hn::Sub(hn::Sub(m.one, m.u), v_only), l, row.here + at);
    hn::Store(v_only, l, row.right + at);
    hn::Store(u_only, l, row.below + at);
    hn::Store(m.uv, l, row.both + at);
  }
}

// One channel of an image of rows x columns: each of its values is the sum of the shares of four cells.
struct ImageSize {
  std::size_t rows;
  std::size_t columns;
};

template <Channel kChannel>
void finish_bilinear(const Support& support, const CellLayout& layout, const std::int64_t* cells, double factor,
                     const ImageSize& size, float* image) {
  const L l;
  RowShares rows[2];
  alignas(64) float line[RowShares::kRoom];
  const std::size_t row_numbers = 4 * layout.row_stride;
  rows[0].clear(support.cell_columns);
  rows[1].clear(support.cell_columns);
  for (std::size_t i = 0; i < size.rows; ++i) {
    RowShares& row = rows[i % 2];
    const RowShares& above = rows[(i + 1) % 2];
    if (i < support.cell_rows) {
      split_row<kChannel>(cells + i * row_numbers, layout.plane_stride, support.cell_columns, row);
    } else {
      row.clear(support.cell_columns);
    }
    for (std::size_t j = 0; j < size.columns; j += hn::Lanes(l)) {
      const std::size_t at = RowShares::kLeft + j;
      const VL from_row = hn::Add(hn::Load(l, row.here + at), hn::LoadU(l, row.right + at - 1));
      const VL from_above = hn::Add(hn::Load(l, above.below + at), hn::LoadU(l, above.both + at - 1));
      write_values(hn::Add(from_row, from_above), factor, line + j);
    }
    std::copy_n(line, size.columns, image + i * size.columns);
  }
}

// Every cell is a value already.
void finish_nearest(const Support& support, const CellLayout& layout, const std::int64_t* cells, float* image) {
  const L l;
  const std::size_t columns = support.cell_columns;
  const std::size_t channel = support.cell_rows * columns;
  alignas(64) float line[2][RowShares::kRoom];
  const bool direct = columns % hn::Lanes(l) == 0;  // whole vectors end where the row ends
  for (std::size_t i = 0; i < support.cell_rows; ++i) {
    const std::int64_t* row = cells + i * layout.row_stride * (support.soft ? 2 : 1);
    float* const first = direct ? image + i * columns : line[0];
    float* const second = direct ? image + channel + i * columns : line[1];
    for (std::size_t j = 0; j < columns; j += hn::Lanes(l)) {
      if (support.soft) {
        VL plain, weighted;
        hn::LoadInterleaved2(l, row + 2 * j, plain, weighted);
        weighted = hn::Sub(weighted, hn::Sub(hn::ShiftLeft<7>(plain), plain));
        write_values(weighted, kUnit, first + j);
        write_values(hn::Sub(plain, weighted), kUnit, second + j);
      } else {
        write_values(hn::Load(l, row + j), kUnit, first + j);
      }
    }
    if (direct) {
      continue;
    }
    std::copy_n(line[0], columns, image + i * columns);
    if (support.soft) {
      std::copy_n(line[1], columns, image + channel + i * columns);
    }
  }
}

// The sum over the whole image in the unit of the sums: every accepted point gives one.
double total_of(const CellLayout& layout, const std::int64_t* cells) {
  std::int64_t total = 0;
  for (std::size_t k = 0; k < layout.plane_stride; k += 4) {
    total += cells[k];
  }
  return static_cast<double>(total);
}

void finish(const Support& support, std::int64_t* cells, std::span<float> image) {
  const CellLayout layout(support);
  if (support.binning == Binning::nearest) {
    finish_nearest(support, layout, cells, image.data());
  } else if (support.convention == SpinConvention::pcl) {
    const double total = total_of(layout, cells);
    const ImageSize size{support.cell_rows + 1, support.cell_columns + 1};
    finish_bilinear<Channel::plain>(support, layout, cells, total > 0.0 ? 1.0 / total : 0.0, size, image.data());
  } else {
    const ImageSize size{support.cell_rows, support.cell_columns};
    if (support.soft) {
      finish_bilinear<Channel::weighted>(support, layout, cells, kUnit, size, image.data());
      finish_bilinear<Channel::rest>(support, layout, cells, kUnit, size, image.data() + size.rows * size.columns);
    } else {
      finish_bilinear<Channel::plain>(support, layout, cells, kUnit, size, image.data());
    }
  }
  std::fill_n(cells, layout.size, 0);
}

}  // namespace
}  // namespace spincat::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // SPINCAT_SPIN_KERNEL_IMAGE_INL_H
