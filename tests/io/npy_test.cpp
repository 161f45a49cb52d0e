#include "spincat/io/npy.h"

#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "support/expect_error.h"
#include "support/temp_dir.h"

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

// An array of bytes: the last index runs fastest, unless it says otherwise.
std::string bytes_array(const std::string& shape, const std::string& bytes, const std::string& order = "False") {
  const std::string dictionary = "{'descr': '|u1', 'fortran_order': " + order + ", 'shape': " + shape + ", }\n";
  return std::string("\x93NUMPY\x01\x00", 8) + static_cast<char>(dictionary.size()) + '\0' + dictionary + bytes;
}

TEST(ReadNpy, ReadsTablesRowByRow) {
  const test::TempDir dir;
  const NumberTable table = read_npy(dir.write("a.npy", bytes_array("(2, 3)", "\1\2\3\4\5\6")));
  EXPECT_EQ(table.rows, 2U);
  EXPECT_EQ(table.columns, 3U);
  EXPECT_EQ(table.values, (std::vector<double>{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(table.at(1, 0), 4.0);
  const NumberTable turned = read_npy(dir.write("b.npy", bytes_array("(2, 3)", "\1\4\2\5\3\6", "True")));
  EXPECT_EQ(turned.values, table.values);
}

TEST(ReadNpy, TakesOneSideAsAColumn) {
  const test::TempDir dir;
  for (const char* order : {"False", "True"}) {
    const NumberTable table = read_npy(dir.write("a.npy", bytes_array("(3,)", "\1\2\3", order)));
    EXPECT_EQ(table.rows, 3U);
    EXPECT_EQ(table.columns, 1U);
    EXPECT_EQ(table.values, (std::vector<double>{1, 2, 3}));
  }
  EXPECT_EQ(read_npy(dir.write("b.npy", bytes_array("(0,)", ""))).rows, 0U);
}

TEST(ReadNpy, SaysWhatIsWrongWithWhichFile) {
  const test::TempDir dir;
  const auto problem = [&](const std::string& bytes) {
    const std::filesystem::path file = dir.write("a.npy", bytes);
    return test::input_error([&] { read_npy(file); });
  };
  const std::string name = (dir / "a.npy").string() + ": ";
  EXPECT_EQ(problem(bytes_array("(1, 1, 2)", "\1\2")),
            name + "holds an array of 1 x 1 x 2; expected one of one or two sides");
  EXPECT_EQ(problem(bytes_array("()", "\1")), name + "holds an array of one number; expected one of one or two sides");
  EXPECT_EQ(problem(bytes_array("(2, 2)", "\1\2")), name + "is cut off: 2 of 4 numbers");
  EXPECT_EQ(problem("1 2 3"), name + "is no NumPy array: it does not begin with its mark");
}

}  // namespace
}  // namespace spincat
