// NumPy's .npy format: what numpy.save writes and numpy.load reads.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace spincat {

// The header of a file (version 1.0) that goes on with the little-endian numbers of an array of this shape, the last
// index running fastest: floats of 32 bits, or what `type` says in NumPy's way. Its length is a multiple of 64, so that
// the numbers can be mapped into memory.
std::string npy_header(std::span<const std::size_t> shape, std::string_view type = "<f4");

// The numbers of a file, row by row. An array with one side is one column.
struct NumberTable {
  std::size_t rows = 0;
  std::size_t columns = 0;
  std::vector<double> values;

  double at(std::size_t row, std::size_t column) const { return values[row * columns + column]; }
};

// Reads an array of one or two sides, of any type of number and any order. Throws InputError, which begins with the
// file, when it is none, is cut off, or has other sides.
NumberTable read_npy(const std::filesystem::path& file);

}  // namespace spincat
