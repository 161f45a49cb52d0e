#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "spincat/encode/encoding.h"
#include "support/expect_error.h"

namespace spincat {
namespace {

SpinImageBlock block_of(std::size_t first, std::size_t count, const SpinImageShape& shape, float start) {
  SpinImageBlock block{first, SpinImages(count, shape)};
  for (std::size_t k = 0; k < count; ++k) {
    for (float& value : block.images.image(k)) {
      value = start++;
    }
  }
  return block;
}

SpinImageParams small_images(int width = 2) {
  SpinImageParams params;
  params.image_width = width;
  return params;
}

TEST(Concatenation, IsTheRowsOfEachImageInTheOrderOfTheSpinPoints) {
  const OrientedPoints points(3);
  const SpinImageParams params = small_images();
  const auto sums = make_encoding("concatenation")->begin(points, points, params);
  ASSERT_EQ(sums->size(), 12U);
  std::vector<double> values(12, 0.0);
  sums->accumulate(block_of(2, 1, params.shape(), 9), values);  // the last image first
  sums->accumulate(block_of(0, 2, params.shape(), 1), values);
  const FeatureVector features = sums->finish(values);
  EXPECT_EQ(features.encoding, "concatenation");
  ASSERT_EQ(features.values.size(), 12U);
  const double length = std::sqrt(650.0);  // 1 + 4 + ... + 144
  for (std::size_t i = 0; i < 12; ++i) {
    EXPECT_FLOAT_EQ(features.values[i], static_cast<float>(static_cast<double>(i + 1) / length));
  }
}

TEST(Concatenation, PartsAddUpToTheWhole) {
  const OrientedPoints points(3);
  const SpinImageParams params = small_images();
  const auto sums = make_encoding("concatenation")->begin(points, points, params);
  std::vector<double> whole(12, 0.0);
  std::vector<double> a(12, 0.0);
  std::vector<double> b(12, 0.0);
  sums->accumulate(block_of(0, 3, params.shape(), 1), whole);
  sums->accumulate(block_of(0, 2, params.shape(), 1), a);
  sums->accumulate(block_of(2, 1, params.shape(), 9), b);
  for (std::size_t i = 0; i < 12; ++i) {
    EXPECT_EQ(a[i] + b[i], whole[i]);
  }
}

TEST(Concatenation, OfEmptyImagesIsAllZeros) {
  const OrientedPoints points(1);
  const auto sums = make_encoding("concatenation")->begin(points, points, small_images());
  EXPECT_EQ(sums->finish(std::vector<double>(4, 0.0)).values, std::vector<float>(4, 0.0F));
}

TEST(Concatenation, TakesAnyImages) {
  for (const SpinConvention convention : {SpinConvention::johnson, SpinConvention::pcl}) {
    SpinImageParams params = small_images(7);
    params.convention = convention;
    make_encoding("concatenation")->check(params);
    const OrientedPoints points(4);
    EXPECT_EQ(make_encoding("concatenation")->begin(points, points, params)->size(), 4 * params.shape().size());
  }
}

TEST(MakeEncoding, KnowsEachByItsName) {
  for (const std::string& name : encoding_names()) {
    EXPECT_EQ(make_encoding(name)->name(), name);
  }
  EXPECT_EQ(test::input_error([] { make_encoding("fisher"); }),
            "encoding 'fisher' is not known (one of pooled-pyramid, concatenation, mean-image, bag-of-features)");
}

}  // namespace
}  // namespace spincat
