// An array in NumPy's .npy format. Private to io.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "spincat/io/formats/binary.h"

namespace spincat::io {

class NpyArray {
 public:
  // Any version, order and byte order; the bytes must outlast it. Throws InputError where they are no array, or hold
  // fewer numbers than they say. Takes no memory for the numbers.
  explicit NpyArray(std::string_view bytes) : NpyArray(bytes, bytes.size()) {}
  // The same of the first bytes of `size`, for a look at the shape: there is no at().
  NpyArray(std::string_view bytes, std::uint64_t size);

  // Whether these bytes, the first of a file, begin an array.
  static bool is_begin(std::string_view bytes) { return bytes.starts_with("\x93NUMPY"); }

  const std::vector<std::uint64_t>& shape() const { return shape_; }
  std::string shape_text() const;  // "1000 x 3"
  // Whether its numbers are of one byte, as those of pictures are.
  bool is_bytes() const { return size_ == 1; }

  // All but the last side, multiplied, and the last one: a table of rows. An array with one side is a column.
  std::uint64_t rows() const;
  std::uint64_t columns() const;
  double at(std::uint64_t row, std::uint64_t column) const;

 private:
  void read_header(std::string_view text);
  void read_type(std::string_view type);
  void read_shape(std::string_view text);

  std::string_view numbers_;
  std::vector<std::uint64_t> shape_;
  ScalarType type_ = ScalarType::float32;
  std::size_t size_ = 0;  // bytes of a number
  bool is_half_ = false;  // floats of 16 bits
  bool columns_first_ = false;
  std::endian order_ = std::endian::little;
};

}  // namespace spincat::io
