#include "spincat/camera/source/depth_png.h"

#include <fmt/format.h>
#include <lodepng.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <memory>

#include "spincat/error.h"

namespace spincat {
namespace {

constexpr unsigned kMostPixels = 8'192;  // along a side
constexpr std::uint64_t kBytesEach = 8;  // the most that a pixel takes while it is decoded: twice raw, then as a float
constexpr std::size_t kMostProfile = 1 << 20;  // bytes of a colour profile, which nobody wants

void check(unsigned error) {
  if (error != 0) {
    throw InputError(fmt::format("is no depth picture that can be read ({})", lodepng_error_text(error)));
  }
}

struct Free {
  void operator()(unsigned char* memory) const { std::free(memory); }
};
using Raw = std::unique_ptr<unsigned char[], Free>;

// The pixels as grey numbers of `bytes_each` bytes. No more is unpacked than a picture of this size can need: what is
// packed may be a thousand times as large.
Raw decode_pixels(std::string_view bytes, unsigned width, unsigned height, unsigned bytes_each) {
  constexpr std::size_t kFilters = 3;  // a byte before each line; interlaced, there are twice as many lines
  lodepng::State state;
  state.info_raw.colortype = LCT_GREY;
  state.info_raw.bitdepth = 8 * bytes_each;
  state.decoder.read_text_chunks = 0;
  state.decoder.max_icc_size = kMostProfile;
  state.decoder.zlibsettings.max_output_size = (std::size_t{width} * bytes_each + kFilters) * (height + 1);
  unsigned char* raw = nullptr;
  const unsigned error =
      lodepng_decode(&raw, &width, &height, &state, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
  Raw pixels(raw);
  check(error);
  return pixels;
}

}  // namespace

PictureKind kind_of_picture(std::string_view bytes) {
  constexpr std::string_view kSignature = "\x89PNG\r\n\x1A\n";
  constexpr std::size_t kPlaceOfBits = 24;
  constexpr std::size_t kPlaceOfColours = 25;
  if (bytes.size() < kKindBytes || !bytes.starts_with(kSignature)) {
    return PictureKind::unknown;
  }
  if (bytes[kPlaceOfColours] != LCT_GREY) {
    return PictureKind::colours;
  }
  return bytes[kPlaceOfBits] == 16 ? PictureKind::depths : PictureKind::few_bits;
}

DepthImage decode_depth_png(std::string_view bytes, double units_per_metre, const ReadLimits& limits) {
  const auto* data = reinterpret_cast<const unsigned char*>(bytes.data());
  lodepng::State state;
  unsigned width = 0;
  unsigned height = 0;
  check(lodepng_inspect(&width, &height, &state, data, bytes.size()));
  if (state.info_png.color.colortype != LCT_GREY) {
    throw InputError("is a picture in colours where a 16-bit grey depth image was expected");
  }
  if (width > kMostPixels || height > kMostPixels) {
    throw InputError(fmt::format("is {} x {} pixels large (at most {} x {})", width, height, kMostPixels, kMostPixels));
  }
  const unsigned bits = state.info_png.color.bitdepth;
  if (bits != 8 && bits != 16) {  // as few would be stretched to 8, and are no units of anything
    throw InputError(
        fmt::format("has pixels of {} bit{} where 16 or 8 bits were expected", bits, bits == 1 ? "" : "s"));
  }
  check_growth(kBytesEach * width * height, bytes.size(), limits);
  const unsigned bytes_each = bits / 8;
  const Raw raw = decode_pixels(bytes, width, height, bytes_each);
  DepthImage image(static_cast<int>(width), static_cast<int>(height));
  for (std::size_t i = 0; i < image.depth.size(); ++i) {
    const unsigned units = bytes_each == 2 ? raw[2 * i] * 256U + raw[2 * i + 1] : raw[i];
    image.depth[i] = static_cast<float>(units / units_per_metre);
  }
  return image;
}

std::string encode_png16(const std::vector<std::uint16_t>& values, int width, int height) {
  std::vector<unsigned char> raw(2 * values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    raw[2 * i] = static_cast<unsigned char>(values[i] >> 8);
    raw[2 * i + 1] = static_cast<unsigned char>(values[i] & 0xFF);
  }
  // Left to itself, lodepng writes 1 to 8 bits where those can tell the grey tones, and a unit is another one then.
  lodepng::State state;
  state.info_raw = lodepng_color_mode_make(LCT_GREY, 16);
  state.info_png.color = state.info_raw;
  state.encoder.auto_convert = 0;
  std::vector<unsigned char> bytes;
  if (const unsigned error =
          lodepng::encode(bytes, raw, static_cast<unsigned>(width), static_cast<unsigned>(height), state);
      error != 0) {
    throw RunError(fmt::format("the picture could not be made ({})", lodepng_error_text(error)));
  }
  return {bytes.begin(), bytes.end()};
}

std::string encode_depth_png(const DepthImage& image, double units_per_metre) {
  std::vector<std::uint16_t> values(image.depth.size());
  std::ranges::transform(image.depth, values.begin(), [&](float z) -> std::uint16_t {
    const double units = std::round(static_cast<double>(z) * units_per_metre);
    return units >= 0.0 && units <= 65'535.0 ? static_cast<std::uint16_t>(units) : 0;
  });
  return encode_png16(values, image.width, image.height);
}

}  // namespace spincat
