// The mean image and the local features of bags of features.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "spincat/encode/codebook.h"
#include "spincat/encode/encoding.h"

namespace spincat {
namespace {

SpinImageParams soft_params(int width) {
  SpinImageParams params;
  params.image_width = width;
  params.binning = Binning::nearest;
  params.angle_test = AngleTest::soft;
  return params;
}

// `images` images with the value k + bin / 8 in bin `bin` of image k.
SpinImages numbered_images(std::size_t images, const SpinImageParams& params) {
  SpinImages result(images, params.shape());
  for (std::size_t k = 0; k < images; ++k) {
    for (std::size_t bin = 0; bin < params.shape().size(); ++bin) {
      result.image(k)[bin] = static_cast<float>(k) + static_cast<float>(bin) / 8.0F;
    }
  }
  return result;
}

FeatureVector encoded(const Encoding& encoding, const SpinImageParams& params, std::size_t images,
                      std::size_t surface_points, std::size_t block = 3) {
  const OrientedPoints surface(surface_points);
  const OrientedPoints spin_points(images);
  const auto object = encoding.begin(surface, spin_points, params);
  std::vector<double> sums(object->size(), 0.0);
  const SpinImages all = numbered_images(images, params);
  for (std::size_t first = 0; first < images; first += block) {
    const std::size_t count = std::min(block, images - first);
    SpinImageBlock part{first, SpinImages(count, params.shape())};
    std::copy_n(all.values().begin() + static_cast<std::ptrdiff_t>(first * params.shape().size()),
                count * params.shape().size(), part.images.values().begin());
    object->accumulate(part, sums);
  }
  return object->finish(sums);
}

TEST(MeanImage, IsTheMeanScaledToLengthOne) {
  const SpinImageParams params = soft_params(3);
  const FeatureVector found = encoded(*make_encoding("mean-image"), params, 5, 10);
  ASSERT_EQ(found.values.size(), 18U);
  EXPECT_EQ(found.blocks, std::vector<std::uint32_t>{18});
  EXPECT_EQ(found.encoding, "mean-image");
  EXPECT_EQ(found.local_size, 0U);
  std::vector<double> mean(18);
  double squared = 0.0;
  for (std::size_t bin = 0; bin < 18; ++bin) {
    mean[bin] = 2.0 + static_cast<double>(bin) / 8.0;  // of 0 to 4
    squared += mean[bin] * mean[bin];
  }
  for (std::size_t bin = 0; bin < 18; ++bin) {
    EXPECT_NEAR(found.values[bin], mean[bin] / std::sqrt(squared), 1e-6);
  }
}

TEST(MeanImage, DoesNotDependOnTheBlocks) {
  const SpinImageParams params = soft_params(3);
  EXPECT_EQ(encoded(*make_encoding("mean-image"), params, 7, 10, 2).values,
            encoded(*make_encoding("mean-image"), params, 7, 10, 7).values);
}

TEST(MeanImage, OfEmptyImagesIsZero) {
  const auto object = make_encoding("mean-image")->begin(OrientedPoints(1), OrientedPoints(1), soft_params(3));
  EXPECT_EQ(object->finish(std::vector<double>(18, 0.0)).values, std::vector<float>(18, 0.0F));
}

TEST(BagOfFeatures, LocalFeaturesAreRootsOfSharesInCells) {
  // 20 x 20 bins become 10 x 10 cells of 2 x 2 bins.
  const SpinImageParams params = soft_params(20);
  const FeatureVector found = encoded(*make_encoding("bag-of-features"), params, 4, 50);
  EXPECT_EQ(found.local_size, 200U);
  ASSERT_EQ(found.values.size(), 200U * kLocalFeatures);
  const SpinImages images = numbered_images(4, params);
  for (const std::size_t k : {0, 3}) {
    for (const std::size_t channel : {0, 1}) {
      for (const std::size_t row : {0, 7}) {
        for (const std::size_t column : {2, 9}) {
          double sum = 0.0;
          for (const std::size_t i : {2 * row, 2 * row + 1}) {
            for (const std::size_t j : {2 * column, 2 * column + 1}) {
              sum += static_cast<double>(images.image(k)[(channel * 20 + i) * 20 + j]);
            }
          }
          EXPECT_NEAR(found.values[k * 200 + (channel * 10 + row) * 10 + column], std::sqrt(sum / 50.0), 1e-5);
        }
      }
    }
  }
}

TEST(BagOfFeatures, FewImagesAreRepeatedAndManyAreCut) {
  const SpinImageParams params = soft_params(4);
  const FeatureVector few = encoded(*make_encoding("bag-of-features"), params, 3, 10);
  const FeatureVector many = encoded(*make_encoding("bag-of-features"), params, kLocalFeatures + 40, 10);
  ASSERT_EQ(few.local_size, 32U);
  ASSERT_EQ(few.values.size(), many.values.size());
  for (std::size_t i = 0; i < 32; ++i) {
    EXPECT_EQ(few.values[i], few.values[3 * 32 + i]);
    EXPECT_EQ(few.values[32 + i], few.values[4 * 32 + i]);
    EXPECT_EQ(few.values[64 + i], many.values[64 + i]);
  }
}

TEST(BagOfFeatures, AnyImageWillDo) {
  SpinImageParams params;
  params.convention = SpinConvention::pcl;
  params.image_width = 8;
  make_encoding("bag-of-features")->check(params);
  EXPECT_TRUE(make_encoding("bag-of-features")->gives_local_features());
  EXPECT_FALSE(make_encoding("mean-image")->gives_local_features());
  EXPECT_EQ(encoded(*make_encoding("bag-of-features"), params, 2, 10).local_size, 90U);  // 9 x 17 bins: 9 x 10 cells
}

TEST(MeanImage, WithoutAnImageIsTheMeanOfTheOthers) {
  const SpinImageParams params = soft_params(3);
  const auto object = make_encoding("mean-image")->begin(OrientedPoints(10), OrientedPoints(4), params);
  const SpinImageBlock all{0, numbered_images(4, params)};
  std::vector<double> sums(object->size(), 0.0);
  object->accumulate(all, sums);
  // Without image 3 what encoded() gives of the first three.
  const std::vector<float> expected = encoded(*make_encoding("mean-image"), params, 3, 10).values;
  const std::vector<float> found = object->finish_without(all, 3, sums).values;
  for (std::size_t bin = 0; bin < expected.size(); ++bin) {
    EXPECT_NEAR(found[bin], expected[bin], 1e-6);
  }
}

TEST(Shares, OfMeanImageAndConcatenationAddUpImageByImage) {
  const SpinImageParams params = soft_params(3);
  for (const char* const name : {"mean-image", "concatenation"}) {
    const auto object = make_encoding(name)->begin(OrientedPoints(10), OrientedPoints(4), params);
    const SpinImageBlock all{0, numbered_images(4, params)};
    std::vector<double> sums(object->size(), 0.0);
    object->accumulate(all, sums);
    const std::vector<float> values = object->finish(sums).values;
    std::vector<float> weights(values.size());
    double product = 0.0;
    for (std::size_t j = 0; j < weights.size(); ++j) {
      weights[j] = static_cast<float>(j % 7) - 2.0F;
      product += static_cast<double>(weights[j]) * static_cast<double>(values[j]);
    }
    std::vector<double> shares(4, 0.0);
    ASSERT_TRUE(object->add_contributions(all, sums, weights, shares)) << name;
    EXPECT_NEAR(shares[0] + shares[1] + shares[2] + shares[3], product, 1e-5) << name;
    EXPECT_NE(shares[0], shares[3]) << name;
  }
}

TEST(BagOfFeatures, WithoutAnImageOthersTakeItsPlace) {
  const SpinImageParams params = soft_params(4);
  const auto object = make_encoding("bag-of-features")->begin(OrientedPoints(10), OrientedPoints(3), params);
  const SpinImageBlock all{0, numbered_images(3, params)};
  std::vector<double> sums(object->size(), 0.0);
  object->accumulate(all, sums);
  const std::vector<float> with_all = object->finish(sums).values;
  const std::vector<float> found = object->finish_without(all, 1, sums).values;
  ASSERT_EQ(found.size(), with_all.size());
  for (std::size_t i = 0; i < 32; ++i) {
    EXPECT_EQ(found[i], with_all[i]);
    EXPECT_EQ(found[32 + i], with_all[64 + i]);
    EXPECT_EQ(found[64 + i], with_all[i]);
  }
  std::vector<double> shares(3, 0.0);
  EXPECT_FALSE(object->add_contributions(all, sums, std::vector<float>(with_all.size()), shares));
}

}  // namespace
}  // namespace spincat
