#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>

#include "spincat/dataset/parts.h"

namespace spincat {
namespace {

namespace fs = std::filesystem;

// The deepest folder that holds all files.
fs::path common_folder(const std::vector<DatasetObject>& objects) {
  fs::path common = objects.front().file.parent_path();
  for (const DatasetObject& object : objects) {
    const fs::path folder = object.file.parent_path();
    const auto [ours, theirs] = std::mismatch(common.begin(), common.end(), folder.begin(), folder.end());
    fs::path shared;
    for (auto name = common.begin(); name != ours; ++name) {
      shared /= *name;
    }
    common = shared;
  }
  return common;
}

}  // namespace

std::string list_checksum(const std::vector<DatasetObject>& objects, const std::vector<std::string>& categories) {
  std::vector<std::string> lines;
  if (!objects.empty()) {
    const fs::path folder = common_folder(objects);
    for (const DatasetObject& object : objects) {
      // A zero byte is in no path: no two lists have the same text.
      lines.push_back(object.file.lexically_relative(folder).generic_string() + '\0' + categories[object.category] +
                      '\0' + object.split + '\0');
    }
  }
  std::ranges::sort(lines);
  uLong crc = crc32(0, nullptr, 0);
  for (const std::string& line : lines) {
    crc = crc32_z(crc, reinterpret_cast<const Bytef*>(line.data()), line.size());
  }
  return fmt::format("{:08x}", crc);
}

}  // namespace spincat
