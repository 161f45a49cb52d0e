#include "spincat/report/picture.h"

#include <gtest/gtest.h>
#include <lodepng.h>

#include <vector>

namespace spincat {
namespace {

// Five images of one channel, 2 x 3 bins, the last bin of each full, the first a quarter full.
SpinImages five_images(std::size_t channels) {
  SpinImages images(5, {channels, 2, 3});
  for (std::size_t k = 0; k < 5; ++k) {
    images.image(k)[0] = 1.0F;
    images.image(k)[5] = 4.0F;
  }
  return images;
}

TEST(ContactSheet, DrawsEachBinAsASquareWithDarkForFull) {
  // 32 pixels a bin; 3 across, 2 down, lines of 4 pixels around every tile.
  const GreyPicture sheet = contact_sheet(five_images(1));
  ASSERT_EQ(sheet.width, 3 * (96 + 4) + 4U);
  ASSERT_EQ(sheet.height, 2 * (64 + 4) + 4U);
  ASSERT_EQ(sheet.values.size(), sheet.width * sheet.height);
  const auto at = [&](std::size_t x, std::size_t y) { return static_cast<int>(sheet.values[y * sheet.width + x]); };
  EXPECT_EQ(at(4, 4), 128);             // a quarter full, by the square root half black
  EXPECT_EQ(at(35, 35), 128);           // still the same bin
  EXPECT_EQ(at(36, 4), 255);            // the next one is empty
  EXPECT_EQ(at(99, 67), 0);             // the fullest
  EXPECT_EQ(at(100, 67), 176);          // the line beside it
  EXPECT_EQ(at(104 + 4, 72 + 4), 128);  // the fifth image, second row
  EXPECT_EQ(at(250, 100), 176);         // no sixth one
}

TEST(ContactSheet, PutsChannelsSideBySideAndAllowsEmptyImages) {
  const GreyPicture sheet = contact_sheet(five_images(2));
  const auto at = [&](std::size_t x, std::size_t y) { return static_cast<int>(sheet.values[y * sheet.width + x]); };
  EXPECT_EQ(at(99, 67), 0);     // channel 0
  EXPECT_EQ(at(195, 67), 255);  // channel 1 is all empty
  EXPECT_EQ(at(196, 67), 176);
}

TEST(EncodePng, GivesBackTheSameValues) {
  const GreyPicture picture{3, 2, {0, 1, 2, 253, 254, 255}};
  const std::string png = encode_png(picture);
  std::vector<unsigned char> decoded;
  unsigned width = 0;
  unsigned height = 0;
  const std::vector<unsigned char> bytes(png.begin(), png.end());
  ASSERT_EQ(lodepng::decode(decoded, width, height, bytes, LCT_GREY, 8), 0U);
  EXPECT_EQ(width, 3U);
  EXPECT_EQ(height, 2U);
  EXPECT_EQ(decoded, picture.values);
}

}  // namespace
}  // namespace spincat
