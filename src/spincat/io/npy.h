// NumPy's .npy format, version 1.0: what numpy.load reads.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace spincat {

// The header of a file that goes on with the little-endian floats of an array of this shape, the last index running
// fastest. Its length is a multiple of 64, so that the numbers can be mapped into memory.
std::string npy_header(std::span<const std::size_t> shape);

}  // namespace spincat
