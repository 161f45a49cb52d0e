#include "spincat/camera/source/depth_png.h"

#include <gtest/gtest.h>
#include <lodepng.h>
#include <zlib.h>

#include <string>
#include <vector>

#include "support/expect_error.h"
#include "support/png_bytes.h"

namespace spincat {
namespace {

using test::input_error;

DepthImage thumbnail() {
  DepthImage image(3, 2);
  image.depth = {0.0F, 0.5F, 1.234F, 65.535F, 0.001F, 2.0F};
  return image;
}

TEST(DepthPng, ReadsWhatItWrote) {
  const DepthImage image = thumbnail();
  const DepthImage back = decode_depth_png(encode_depth_png(image, 1000.0), 1000.0);
  EXPECT_EQ(back.width, 3);
  EXPECT_EQ(back.height, 2);
  for (std::size_t i = 0; i < image.depth.size(); ++i) {
    EXPECT_NEAR(back.depth[i], image.depth[i], 1e-6F);
  }
}

// In 1 bit or 8 these would be smaller, and other depths.
TEST(DepthPng, WritesSixteenBitsWhateverThePixelsAre) {
  constexpr std::size_t kPlaceOfBits = 24;
  for (const float depth : {0.0F, 0.257F, 65.535F}) {
    DepthImage image(3, 2);
    image.depth.back() = depth;
    const std::string bytes = encode_depth_png(image, 1000.0);
    EXPECT_EQ(bytes.at(kPlaceOfBits), '\x10') << depth;
    EXPECT_NEAR(decode_depth_png(bytes, 1000.0).depth.back(), depth, 1e-6F);
  }
}

TEST(DepthPng, KnowsUnits) {
  const std::string bytes = encode_depth_png(thumbnail(), 1000.0);
  EXPECT_NEAR(decode_depth_png(bytes, 5000.0).at(2, 1), 0.4F, 1e-6F);
}

TEST(DepthPng, HasNoReadingForWhatIsTooFar) {
  EXPECT_EQ(decode_depth_png(encode_depth_png(thumbnail(), 5000.0), 5000.0).at(0, 1), 0.0F);
}

TEST(DepthPng, RefusesWhatIsNoDepthPicture) {
  const std::string bytes = encode_depth_png(thumbnail(), 1000.0);
  for (std::size_t length = 0; length < bytes.size() - 12; ++length) {  // the last chunk's end is not needed
    EXPECT_NE(input_error([&] { decode_depth_png(bytes.substr(0, length), 1000.0); }), "no error") << length;
  }
  EXPECT_NE(input_error([&] { decode_depth_png("not a PNG file", 1000.0); }).find("no depth picture"),
            std::string::npos);
  std::vector<unsigned char> colours;
  ASSERT_EQ(lodepng::encode(colours, std::vector<unsigned char>(12, 9), 2, 2, LCT_RGB, 8), 0U);
  EXPECT_NE(input_error([&] {
              decode_depth_png({reinterpret_cast<char*>(colours.data()), colours.size()}, 1000.0);
            }).find("is a picture in colours where a 16-bit grey depth image was expected"),
            std::string::npos);
}

std::string packed(const std::string& pixels) {
  std::string bytes(compressBound(pixels.size()), '\0');
  uLongf length = bytes.size();
  compress(reinterpret_cast<Bytef*>(bytes.data()), &length, reinterpret_cast<const Bytef*>(pixels.data()),
           pixels.size());
  bytes.resize(length);
  return bytes;
}

TEST(DepthPng, UnpacksNoMoreThanThePictureTakes) {
  using namespace std::string_literals;
  const std::string line = "\0\1\0\2\0"s;  // no filter, two pixels
  const std::string good = test::png_file(2, 2, 16, 0, test::png_chunk("IDAT", packed(line + line)));
  EXPECT_EQ(decode_depth_png(good, 256.0).at(1, 1), 2.0F);
  const std::string more = packed(line + line + std::string(100'000, '\0'));
  EXPECT_NE(input_error([&] {
              decode_depth_png(test::png_file(2, 2, 16, 0, test::png_chunk("IDAT", more)), 256.0);
            }).find("larger than"),
            std::string::npos);
}

TEST(DepthPng, ReadsPixelsOfBothDepthsInterlacedOrNot) {
  using namespace std::string_literals;
  // 1 x 1: the first of Adam7's passes has the only pixel
  for (const char interlaced : {'\0', '\1'}) {
    EXPECT_EQ(decode_depth_png(test::png_file(1, 1, 16, interlaced, test::png_chunk("IDAT", packed("\0\2\1"s))), 1.0)
                  .at(0, 0),
              513.0F);
    EXPECT_EQ(
        decode_depth_png(test::png_file(1, 1, 8, interlaced, test::png_chunk("IDAT", packed("\0\x80"s))), 1.0).at(0, 0),
        128.0F);
  }
}

// 1, 2 and 4 bits would be stretched to 8: a grey tone, no depth.
TEST(DepthPng, RefusesPixelsOfFewBits) {
  using namespace std::string_literals;
  for (const char bits : {'\1', '\2', '\4'}) {
    const std::string bytes = test::png_file(1, 1, bits, 0, test::png_chunk("IDAT", packed("\0\x80"s)));
    EXPECT_EQ(input_error([&] { decode_depth_png(bytes, 1.0); }), "has pixels of "s + static_cast<char>('0' + bits) +
                                                                      (bits == 1 ? " bit" : " bits") +
                                                                      " where 16 or 8 bits were expected");
  }
}

TEST(DepthPng, TellsKindsOfPicturesByTheirFirstBytes) {
  const std::string depths = encode_depth_png(thumbnail(), 1000.0);
  EXPECT_EQ(kind_of_picture(depths.substr(0, kKindBytes)), PictureKind::depths);
  EXPECT_EQ(kind_of_picture(depths.substr(0, kKindBytes - 1)), PictureKind::unknown);
  EXPECT_EQ(kind_of_picture("x" + depths), PictureKind::unknown);
  EXPECT_EQ(kind_of_picture(test::png_file(1, 1, 8, 0, "")), PictureKind::few_bits);
  EXPECT_EQ(kind_of_picture(test::png_file(1, 1, 1, 0, "")), PictureKind::few_bits);
  for (const LodePNGColorType type : {LCT_RGB, LCT_RGBA, LCT_GREY_ALPHA}) {
    for (const unsigned bits : {8U, 16U}) {
      std::vector<unsigned char> file;
      lodepng::State state;
      state.info_raw = lodepng_color_mode_make(type, bits);
      state.info_png.color = state.info_raw;
      state.encoder.auto_convert = 0;
      ASSERT_EQ(lodepng::encode(file, std::vector<unsigned char>(64, 9), 2, 2, state), 0U);
      EXPECT_EQ(kind_of_picture({reinterpret_cast<char*>(file.data()), file.size()}), PictureKind::colours);
    }
  }
}

TEST(DepthPng, RefusesLargePicturesInSmallFiles) {
  const DepthImage flat(4'096, 1'024);
  const std::string bytes = encode_depth_png(flat, 1000.0);
  EXPECT_NE(input_error([&] { decode_depth_png(bytes, 1000.0); }).find("--max-growth"), std::string::npos);
  ReadLimits raised;
  raised.max_growth = 100'000;
  EXPECT_EQ(decode_depth_png(bytes, 1000.0, raised).width, 4'096);
}

}  // namespace
}  // namespace spincat
