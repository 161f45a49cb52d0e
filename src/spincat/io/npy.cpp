#include "spincat/io/npy.h"

#include <fmt/format.h>

#include "spincat/error.h"
#include "spincat/files/file.h"
#include "spincat/files/paths.h"
#include "spincat/io/formats/npy_array.h"

namespace spincat {

std::string npy_header(std::span<const std::size_t> shape, std::string_view type) {
  std::string sizes;
  for (const std::size_t size : shape) {
    sizes += fmt::format("{}, ", size);  // a trailing comma is fine in a Python tuple, and needed for one number
  }
  std::string dictionary = fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({}), }}", type, sizes);
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

NumberTable read_npy(const std::filesystem::path& file) {
  const std::string bytes = read_file(file);
  return naming_file(file, [&] {
    const io::NpyArray array(bytes);
    if (array.shape().empty() || array.shape().size() > 2) {
      throw InputError(fmt::format("holds an array of {}; expected one of one or two sides", array.shape_text()));
    }
    NumberTable table{array.rows(), array.columns(), {}};
    table.values.reserve(table.rows * table.columns);
    for (std::size_t i = 0; i < table.rows; ++i) {
      for (std::size_t j = 0; j < table.columns; ++j) {
        table.values.push_back(array.at(i, j));
      }
    }
    return table;
  });
}

}  // namespace spincat
