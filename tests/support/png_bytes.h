// PNG files, chunk by chunk: such as no encoder would write.
#pragma once

#include <zlib.h>

#include <cstdint>
#include <string>
#include <string_view>

namespace spincat::test {

inline std::string big_endian(std::uint32_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) {
    bytes += static_cast<char>(value >> shift & 0xFF);
  }
  return bytes;
}

// With the right checksum.
inline std::string png_chunk(std::string_view name, std::string_view content) {
  const std::string named = std::string(name) + std::string(content);
  const uLong checksum = crc32_z(0, reinterpret_cast<const Bytef*>(named.data()), named.size());
  return big_endian(static_cast<std::uint32_t>(content.size())) + named +
         big_endian(static_cast<std::uint32_t>(checksum));
}

// A grey picture. `chunks` has its pixels.
inline std::string png_file(std::uint32_t width, std::uint32_t height, char bits, char interlaced,
                            const std::string& chunks) {
  const std::string head = big_endian(width) + big_endian(height) + bits + std::string(3, '\0') + interlaced;
  return "\x89PNG\r\n\x1A\n" + png_chunk("IHDR", head) + chunks + png_chunk("IEND", "");
}

}  // namespace spincat::test
