#include "spincat/io/formats/lzf.h"

#include "spincat/error.h"

namespace spincat::io {

std::string unpack_lzf(std::string_view packed, std::size_t size) {
  std::string out;
  out.reserve(size);
  std::size_t at = 0;
  const auto fail = [] { throw InputError("its compressed points are damaged"); };
  const auto next = [&]() -> std::size_t {
    if (at == packed.size()) {
      fail();
    }
    return static_cast<unsigned char>(packed[at++]);
  };
  while (at < packed.size()) {
    const std::size_t control = next();
    if (control < 32) {
      const std::size_t run = control + 1;
      if (run > packed.size() - at || run > size - out.size()) {
        fail();
      }
      out.append(packed.substr(at, run));
      at += run;
    } else {
      std::size_t length = control >> 5;
      if (length == 7) {
        length += next();
      }
      length += 2;
      const std::size_t back = ((control & 31) << 8) + next() + 1;
      if (back > out.size() || length > size - out.size()) {
        fail();
      }
      // Byte by byte: the copy may run into what it has just written.
      for (std::size_t i = 0; i < length; ++i) {
        out.push_back(out[out.size() - back]);
      }
    }
  }
  if (out.size() != size) {
    fail();
  }
  return out;
}

}  // namespace spincat::io
