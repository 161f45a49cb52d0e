// ZIP archives for tests.
#pragma once

#include <zlib.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/bytes.h"

namespace spincat::test {

inline std::string deflated(const std::string& bytes) {
  std::string packed(compressBound(bytes.size()) + 16, '\0');
  z_stream stream{};
  deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, -MAX_WBITS, 9, Z_DEFAULT_STRATEGY);
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  deflate(&stream, Z_FINISH);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  return packed;
}

// The head of a part, as it stands before it (and, with a few more numbers, in the list at the end).
inline std::string zip_head(const std::string& name, const std::string& bytes, const std::string& packed, int method) {
  const auto checksum =
      static_cast<std::uint32_t>(crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
  return little_row<std::uint16_t>(20, 0, method, 0, 0) +
         little_row<std::uint32_t>(checksum, packed.size(), bytes.size()) + little_row<std::uint16_t>(name.size(), 0);
}

inline std::string zip(const std::vector<std::pair<std::string, std::string>>& parts, bool deflate_them = true) {
  std::string archive, list;
  for (const auto& [name, bytes] : parts) {
    const std::string packed = deflate_them ? deflated(bytes) : bytes;
    const std::string head = zip_head(name, bytes, packed, deflate_them ? 8 : 0);
    list += "PK\1\2" + little_row<std::uint16_t>(20) + head + little_row<std::uint16_t>(0, 0, 0) +
            little_row<std::uint32_t>(0, archive.size()) + name;
    archive += "PK\3\4" + head + name + packed;
  }
  const std::size_t begin = archive.size();
  return archive + list + "PK\5\6" + little_row<std::uint16_t>(0, 0, parts.size(), parts.size()) +
         little_row<std::uint32_t>(list.size(), begin) + little_row<std::uint16_t>(0);
}

}  // namespace spincat::test
