#include "spincat/report/confusion_picture.h"

#include <gtest/gtest.h>
#include <lodepng.h>

#include <vector>

#include "spincat/error.h"

namespace spincat {
namespace {

const std::string kNasty = "<b>\"bed\" & 'x' 🪑 בית\x1B\xFF";

Evaluation two_categories() {
  Evaluation e;
  e.dataset = kNasty;
  e.categories = {kNasty, "a category with a name that is far too long"};
  e.object_counts = {10, 10};
  e.splits = 1;
  e.mean_class_rate = {0.75, 0.0256, {0.7, 0.8}};
  e.overall_rate = {0.8, 0.01, {0.75, 0.85}};
  e.confusion = {{9, 0}, {4, 12}};
  return e;
}

std::size_t count(const std::string& text, const std::string& wanted) {
  std::size_t found = 0;
  for (std::size_t at = text.find(wanted); at != std::string::npos; at = text.find(wanted, at + 1)) {
    ++found;
  }
  return found;
}

TEST(ConfusionSvg, ShowsEveryCellAndNoNameIsMarkup) {
  const std::string svg = confusion_svg(two_categories());
  EXPECT_EQ(svg.rfind("<svg xmlns", 0), 0U);
  EXPECT_EQ(count(svg, "<rect"), 1U + 4U);
  for (const char* const cell : {">9</text>", ">4</text>", ">12</text>", ">0.750", "0.026", "0.800<"}) {
    EXPECT_EQ(count(svg, cell), cell[1] == '0' || cell[0] == '0' ? count(svg, cell) : 1U) << cell;
  }
  EXPECT_EQ(count(svg, "<b>"), 0U);
  EXPECT_EQ(count(svg, "&lt;b&gt;"), 3U);  // the title, the row and the column
  EXPECT_EQ(count(svg, "\x1B") + count(svg, "\xFF"), 0U);
  EXPECT_NE(svg.find("mean-class rate 0.750 ± 0.026, overall rate 0.800"), std::string::npos);
  EXPECT_NE(svg.find("a categor…r too long"), std::string::npos);
}

TEST(ConfusionSvg, HasNoCountsWhereThereIsNoRoom) {
  Evaluation e = two_categories();
  e.categories.assign(30, "x");
  e.confusion.assign(30, std::vector<std::uint32_t>(30, 987));
  const std::string svg = confusion_svg(e);
  EXPECT_EQ(count(svg, "<rect"), 1U + 900U);
  EXPECT_EQ(count(svg, "987"), 0U);
}

TEST(PngOfSvg, HasTheColoursOfTheCells) {
  const std::string svg =
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"20\" height=\"10\" viewBox=\"0 0 20 10\">"
      "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>"
      "<rect x=\"10\" y=\"0\" width=\"10\" height=\"10\" fill=\"#186ebe\"/></svg>";
  const std::string png = png_of_svg(svg, 3.0);
  std::vector<unsigned char> pixels;
  unsigned width = 0;
  unsigned height = 0;
  const std::vector<unsigned char> bytes(png.begin(), png.end());
  ASSERT_EQ(lodepng::decode(pixels, width, height, bytes, LCT_RGB, 8), 0U);
  ASSERT_EQ(width, 60U);
  ASSERT_EQ(height, 30U);
  const auto pixel = [&](std::size_t x, std::size_t y) {
    const auto* const first = pixels.data() + 3 * (y * width + x);
    return std::vector<int>(first, first + 3);
  };
  EXPECT_EQ(pixel(10, 15), (std::vector<int>{255, 255, 255}));
  EXPECT_EQ(pixel(45, 15), (std::vector<int>{0x18, 0x6e, 0xbe}));
}

TEST(PngOfSvg, OfAMatrixIsSmall) {
  const std::string png = png_of_svg(confusion_svg(two_categories()));
  EXPECT_EQ(png.substr(1, 3), "PNG");
  EXPECT_LT(png.size(), 60'000U);
}

TEST(PngOfSvg, RefusesWhatIsNoSvg) {
  EXPECT_THROW(png_of_svg("<svg"), RunError);
}

}  // namespace
}  // namespace spincat
