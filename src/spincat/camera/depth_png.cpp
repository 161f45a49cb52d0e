#include "spincat/camera/depth_png.h"

#include <fmt/format.h>
#include <lodepng.h>

#include <algorithm>
#include <cmath>

#include "spincat/error.h"

namespace spincat {
namespace {

constexpr unsigned kMostPixels = 8'192;  // along a side

void check(unsigned error) {
  if (error != 0) {
    throw InputError(fmt::format("is no depth picture that can be read ({})", lodepng_error_text(error)));
  }
}

}  // namespace

DepthImage decode_depth_png(std::string_view bytes, double units_per_metre) {
  const auto* data = reinterpret_cast<const unsigned char*>(bytes.data());
  lodepng::State state;
  unsigned width = 0;
  unsigned height = 0;
  check(lodepng_inspect(&width, &height, &state, data, bytes.size()));
  if (state.info_png.color.colortype != LCT_GREY) {
    throw InputError("is a picture in colours where a grey one of depths was expected");
  }
  if (width > kMostPixels || height > kMostPixels) {
    throw InputError(fmt::format("is {} x {} pixels large (at most {} x {})", width, height, kMostPixels, kMostPixels));
  }
  const unsigned bytes_each = state.info_png.color.bitdepth == 16 ? 2 : 1;
  std::vector<unsigned char> raw;
  check(lodepng::decode(raw, width, height, data, bytes.size(), LCT_GREY, 8 * bytes_each));
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
  std::vector<unsigned char> bytes;
  if (const unsigned error =
          lodepng::encode(bytes, raw, static_cast<unsigned>(width), static_cast<unsigned>(height), LCT_GREY, 16);
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
