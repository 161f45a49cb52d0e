#include "spincat/report/picture.h"

#include <lodepng.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "spincat/error.h"

namespace spincat {
namespace {

constexpr std::size_t kTileWidth = 96;  // at least as many pixels for the columns of one channel
constexpr std::size_t kGap = 4;
constexpr std::uint8_t kPaper = 255;
constexpr std::uint8_t kLine = 176;

// Draws one channel of an image with its upper left corner at (left, top), `scale` pixels a bin.
void draw_channel(std::span<const float> bins, const SpinImageShape& shape, std::size_t scale, std::size_t left,
                  std::size_t top, GreyPicture& picture) {
  const float fullest = std::max(*std::ranges::max_element(bins), 0.0F);
  for (std::size_t y = 0; y < shape.rows * scale; ++y) {
    std::uint8_t* row = picture.values.data() + (top + y) * picture.width + left;
    for (std::size_t x = 0; x < shape.columns * scale; ++x) {
      const float share = fullest > 0.0F ? bins[y / scale * shape.columns + x / scale] / fullest : 0.0F;
      row[x] = static_cast<std::uint8_t>(std::lround(kPaper * (1.0F - std::sqrt(std::max(share, 0.0F)))));
    }
  }
}

}  // namespace

GreyPicture contact_sheet(const SpinImages& images) {
  const SpinImageShape shape = images.shape();
  const std::size_t scale = std::max<std::size_t>(1, (kTileWidth + shape.columns - 1) / shape.columns);
  const auto across = static_cast<std::size_t>(
      std::ceil(std::sqrt(static_cast<double>(images.count()) / static_cast<double>(shape.channels))));
  const std::size_t down = (images.count() + across - 1) / std::max<std::size_t>(across, 1);
  const std::size_t tile_width = shape.channels * shape.columns * scale + kGap;
  const std::size_t tile_height = shape.rows * scale + kGap;
  GreyPicture picture{across * tile_width + kGap, down * tile_height + kGap, {}};
  picture.values.assign(picture.width * picture.height, kLine);
  for (std::size_t k = 0; k < images.count(); ++k) {
    for (std::size_t channel = 0; channel < shape.channels; ++channel) {
      const std::size_t size = shape.rows * shape.columns;
      draw_channel(images.image(k).subspan(channel * size, size), shape, scale,
                   kGap + k % across * tile_width + channel * shape.columns * scale, kGap + k / across * tile_height,
                   picture);
    }
  }
  return picture;
}

std::string encode_png(const GreyPicture& picture) {
  std::vector<unsigned char> bytes;
  const unsigned error = lodepng::encode(bytes, picture.values, static_cast<unsigned>(picture.width),
                                         static_cast<unsigned>(picture.height), LCT_GREY, 8);
  if (error != 0) {
    throw RunError(lodepng_error_text(error));
  }
  return {bytes.begin(), bytes.end()};
}

}  // namespace spincat
