// LZF, the compression of PCD files. Private to io.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace spincat::io {

// Unpacks runs of literal bytes, and copies of up to 264 bytes from at most 8 kB back. Throws InputError when the bytes
// do not unpack to exactly `size` bytes.
std::string unpack_lzf(std::string_view packed, std::size_t size);

}  // namespace spincat::io
