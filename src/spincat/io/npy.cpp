#include "spincat/io/npy.h"

#include <fmt/format.h>

namespace spincat {

std::string npy_header(std::span<const std::size_t> shape) {
  std::string sizes;
  for (const std::size_t size : shape) {
    sizes += fmt::format("{}, ", size);  // a trailing comma is fine in a Python tuple, and needed for one number
  }
  std::string dictionary = fmt::format("{{'descr': '<f4', 'fortran_order': False, 'shape': ({}), }}", sizes);
  constexpr std::size_t kBefore = 10;  // magic, version, length
  constexpr std::size_t kAlign = 64;
  const std::size_t length = (kBefore + dictionary.size() + 1 + kAlign - 1) / kAlign * kAlign - kBefore;
  dictionary.resize(length - 1, ' ');
  dictionary += '\n';
  std::string header("\x93NUMPY\x01\x00", 8);
  header += static_cast<char>(length & 0xFFU);
  header += static_cast<char>(length >> 8U);
  return header + dictionary;
}

}  // namespace spincat
