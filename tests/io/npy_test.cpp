#include "spincat/io/npy.h"

#include <gtest/gtest.h>

#include <array>
#include <string>

namespace spincat {
namespace {

TEST(NpyHeader, IsWhatNumPyWritesItself) {
  // numpy.save of a float32 array of shape (3, 20, 20), the first 128 bytes.
  std::string expected("\x93NUMPY\x01\x00\x76\x00", 10);
  expected += "{'descr': '<f4', 'fortran_order': False, 'shape': (3, 20, 20, ), }";
  expected.resize(127, ' ');
  expected += '\n';
  EXPECT_EQ(npy_header(std::array<std::size_t, 3>{3, 20, 20}), expected);
}

TEST(NpyHeader, KeepsItsLengthAndItsAlignmentForAnyShape) {
  for (const std::size_t count : {0UL, 1UL, 999'999'999'999UL, 18'000'000'000'000'000'000UL}) {
    const std::string header = npy_header(std::array{count, count, count, count});
    EXPECT_EQ(header.size() % 64, 0U);
    EXPECT_EQ(header.size(),
              10U + static_cast<unsigned char>(header[8]) + 256U * static_cast<unsigned char>(header[9]));
    EXPECT_EQ(header.back(), '\n');
  }
  EXPECT_NE(npy_header(std::array<std::size_t, 1>{7}).find("(7, )"), std::string::npos);
}

}  // namespace
}  // namespace spincat
