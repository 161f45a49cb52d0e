#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "spincat/encode/encoding.h"
#include "spincat/geometry/random.h"
#include "support/expect_error.h"

namespace spincat {
namespace {

using test::input_error;

SpinImageParams soft_images(int width) {
  SpinImageParams params;
  params.image_width = width;
  params.binning = Binning::nearest;
  params.angle_test = AngleTest::soft;
  return params;
}

OrientedPoints random_points(std::size_t count, Random& random) {
  OrientedPoints points(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3d p(random.normal(), random.normal(), random.normal());
    const Eigen::Vector3d n(random.normal(), random.normal(), random.normal());
    points.set(i, (p.normalized() * random.uniform()).cast<float>(), n.normalized().cast<float>());
  }
  return points;
}

// Sparse images of whole and halved counts, as nearest bins and soft angles make them.
SpinImages random_images(std::size_t count, const SpinImageShape& shape, Random& random) {
  SpinImages images(count, shape);
  for (std::size_t k = 0; k < count; ++k) {
    for (float& value : images.image(k)) {
      value = random.below(3) == 0 ? 0.5F * static_cast<float>(random.below(9)) : 0.0F;
    }
  }
  return images;
}

SpinImageBlock block_of(const SpinImages& images, std::size_t first, std::size_t count) {
  SpinImageBlock block{first, SpinImages(count, images.shape())};
  for (std::size_t k = 0; k < count; ++k) {
    std::ranges::copy(images.image(first + k), block.images.image(k).begin());
  }
  return block;
}

FeatureVector encoded(const OrientedPoints& surface, const OrientedPoints& spin_points, const SpinImages& images,
                      const SpinImageParams& params) {
  const auto sums = make_encoding("pooled-pyramid")->begin(surface, spin_points, params);
  std::vector<double> values(sums->size(), 0.0);
  sums->accumulate(block_of(images, 0, images.count()), values);
  return sums->finish(values);
}

constexpr std::size_t kNone = ~std::size_t{0};

// The recipe again, step by step and slowly: bands by counting who comes before, moments from lists of values, of all
// images but `left_out`.
std::vector<double> by_recipe(const OrientedPoints& surface, const OrientedPoints& spin_points,
                              const SpinImages& images, std::size_t left_out = kNone) {
  Eigen::Vector3d g = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < surface.size(); ++i) {
    g += surface.position(i).cast<double>() / static_cast<double>(surface.size());
  }
  const std::size_t m = spin_points.size();
  std::vector<double> r(m);
  std::vector<double> h(m);
  for (std::size_t k = 0; k < m; ++k) {
    const Eigen::Vector3d d = spin_points.position(k).cast<double>() - g;
    r[k] = d.norm();
    h[k] = std::abs(d.dot(spin_points.normal(k).cast<double>()));
  }
  const auto before = [](const std::vector<double>& key, std::size_t k, const auto& counts) {
    std::size_t n = 0;
    for (std::size_t other = 0; other < key.size(); ++other) {
      n += counts(other) && key[other] < key[k] ? 1 : 0;
    }
    return n;
  };
  std::vector<bool> outer(m);
  for (std::size_t k = 0; k < m; ++k) {
    outer[k] = before(r, k, [](std::size_t) { return true; }) >= m / 2;
  }
  std::vector<std::size_t> band(m);
  for (std::size_t k = 0; k < m; ++k) {
    const std::size_t half = outer[k] ? m - m / 2 : m / 2;
    const std::size_t rank = before(h, k, [&](std::size_t other) { return outer[other] == outer[k]; });
    band[k] = (outer[k] ? 2 : 0) + (rank >= half / 2 ? 1 : 0);
  }

  const SpinImageShape shape = images.shape();
  const std::size_t w = shape.columns;
  const std::size_t cells = w / 4;
  std::vector<double> features;
  for (std::size_t level = 0; level < 3; ++level) {
    const std::size_t edge = level == 0 ? 1 : level == 1 ? 2 : 4;
    std::vector<double> of_level;
    for (std::size_t b = 0; b < 4; ++b) {
      for (std::size_t channel = 0; channel < shape.channels; ++channel) {
        std::vector<double> means;
        std::vector<double> deviations;
        for (std::size_t cell = 0; cell < cells * cells; ++cell) {
          std::vector<double> values;
          for (std::size_t k = 0; k < m; ++k) {
            if (band[k] != b || k == left_out) {
              continue;
            }
            double sum = 0.0;
            for (std::size_t i = 0; i < edge; ++i) {
              for (std::size_t j = 0; j < edge; ++j) {
                const std::size_t row = w / 2 - cells * edge / 2 + cell / cells * edge + i;
                const std::size_t column = cell % cells * edge + j;
                sum += images.image(k)[(channel * w + row) * w + column];
              }
            }
            values.push_back(std::sqrt(sum / static_cast<double>(surface.size())));
          }
          double mean = 0.0;
          for (const double v : values) {
            mean += v / static_cast<double>(values.size());
          }
          double variance = 0.0;
          for (const double v : values) {
            variance += (v - mean) * (v - mean) / static_cast<double>(values.size());
          }
          means.push_back(mean);
          deviations.push_back(std::sqrt(variance));
        }
        of_level.insert(of_level.end(), means.begin(), means.end());
        of_level.insert(of_level.end(), deviations.begin(), deviations.end());
      }
    }
    double squares = 0.0;
    for (const double v : of_level) {
      squares += v * v;
    }
    for (const double v : of_level) {
      features.push_back(squares > 0.0 ? v / std::sqrt(3.0 * squares) : 0.0);
    }
  }
  return features;
}

class PooledPyramidOf : public testing::TestWithParam<std::pair<int, std::size_t>> {};

TEST_P(PooledPyramidOf, IsTheRecipe) {
  const auto [width, count] = GetParam();
  Random random(1);
  const OrientedPoints surface = random_points(200, random);
  const OrientedPoints spin_points = random_points(count, random);
  const SpinImageParams params = soft_images(width);
  const SpinImages images = random_images(count, params.shape(), random);
  const std::vector<double> expected = by_recipe(surface, spin_points, images);
  const FeatureVector features = encoded(surface, spin_points, images, params);
  EXPECT_EQ(features.encoding, "pooled-pyramid");
  ASSERT_EQ(features.values.size(), expected.size());
  double worst = 0.0;
  double squares = 0.0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    worst = std::max(worst, std::abs(features.values[i] - expected[i]));
    squares += features.values[i] * static_cast<double>(features.values[i]);
  }
  EXPECT_LT(worst, 1e-6);  // features are about 0.02; singles are exact to 1e-9 there
  EXPECT_NEAR(squares, 1.0, 1e-6);
}

// Also fewer spin points than bands, and numbers that four does not divide.
INSTANTIATE_TEST_SUITE_P(Sizes, PooledPyramidOf,
                         testing::Values(std::pair(40, 256), std::pair(8, 64), std::pair(16, 7), std::pair(8, 5),
                                         std::pair(8, 3), std::pair(8, 2), std::pair(8, 1)));

TEST(PooledPyramid, OfTheDefaultSettingsHas4800Numbers) {
  const OrientedPoints points(4);
  EXPECT_EQ(make_encoding("pooled-pyramid")->begin(points, points, soft_images(40))->size(), 4800U);
}

TEST(PooledPyramid, SortsSpinPointsIntoBandsByRThenH) {
  // g is the origin. By hand: r = 1, 1, 2, 2, 3, 3, 4, 4, h = r |cosine|.
  OrientedPoints points(8);
  points.set(0, {1, 0, 0}, {0, 1, 0});   // r 1, h 0: inner half, lower quarter: band 0
  points.set(1, {-1, 0, 0}, {1, 0, 0});  // r 1, h 1: band 1, h counts without sign
  points.set(2, {0, 2, 0}, {0, 1, 0});   // r 2, h 2: band 1
  points.set(3, {0, -2, 0}, {1, 0, 0});  // r 2, h 0: band 0
  points.set(4, {0, 0, 3}, {0, 0, -1});  // r 3, h 3: band 2 (the outer half's h are 3, 3, 4, 4)
  points.set(5, {0, 0, -3}, {0, 0, 1});  // r 3, h 3: band 2
  points.set(6, {4, 0, 0}, {1, 0, 0});   // r 4, h 4: band 3
  points.set(7, {-4, 0, 0}, {1, 0, 0});  // r 4, h 4: band 3
  const std::vector<std::size_t> bands = {0, 1, 1, 0, 2, 2, 3, 3};
  const SpinImageParams params = soft_images(8);
  for (std::size_t k = 0; k < 8; ++k) {
    SpinImages images(8, params.shape());
    images.image(k)[3 * 8] = 1.0F;  // within every level
    const std::vector<float> features = encoded(points, points, images, params).values;
    ASSERT_EQ(features.size(), 3U * 4 * 2 * 2 * 4);
    for (std::size_t i = 0; i < features.size(); ++i) {
      const std::size_t band = i / (2 * 2 * 4) % 4;
      EXPECT_TRUE(features[i] == 0.0F || band == bands[k]) << "spin point " << k << ", feature " << i;
    }
    EXPECT_GT(*std::ranges::max_element(features), 0.0F);
  }
}

TEST(PooledPyramid, BlocksGiveTheSameSumsWhereverTheyAreAccumulated) {
  Random random(2);
  const OrientedPoints points = random_points(130, random);
  const SpinImageParams params = soft_images(8);
  const SpinImages images = random_images(130, params.shape(), random);
  const auto sums = make_encoding("pooled-pyramid")->begin(points, points, params);
  std::vector<double> together(sums->size(), 0.0);
  std::vector<double> added(sums->size(), 0.0);
  sums->accumulate(block_of(images, 0, 130), together);
  for (const auto& [first, count] : {std::pair<std::size_t, std::size_t>(0, 64), {64, 64}, {128, 2}}) {
    std::vector<double> part(sums->size(), 0.0);
    sums->accumulate(block_of(images, first, count), part);
    for (std::size_t i = 0; i < part.size(); ++i) {
      added[i] += part[i];
    }
  }
  for (std::size_t i = 0; i < added.size(); ++i) {
    EXPECT_NEAR(added[i], together[i], 1e-12 * (1.0 + together[i]));
  }
  EXPECT_EQ(sums->finish(added).values.size(), sums->size());
}

TEST(PooledPyramid, OfEmptyImagesIsAllZeros) {
  const OrientedPoints points(6);
  const SpinImageParams params = soft_images(8);
  const std::vector<float> features = encoded(points, points, SpinImages(6, params.shape()), params).values;
  EXPECT_EQ(features, std::vector<float>(features.size(), 0.0F));
}

TEST(PooledPyramid, OfEqualImagesHasNoDeviation) {
  const OrientedPoints points(8);
  const SpinImageParams params = soft_images(8);
  SpinImages images(8, params.shape());
  for (std::size_t k = 0; k < 8; ++k) {
    std::ranges::fill(images.image(k), 0.3F);
  }
  const std::vector<float> features = encoded(points, points, images, params).values;
  for (std::size_t i = 0; i < features.size(); ++i) {
    if (i / 4 % 2 == 0) {
      EXPECT_GT(features[i], 0.05F);
    } else {
      EXPECT_LT(features[i], 1e-7F);
    }
  }
}

TEST(PooledPyramid, RefusesImagesThatItCannotReduce) {
  const auto encoding = make_encoding("pooled-pyramid");
  encoding->check(soft_images(8));
  EXPECT_NE(input_error([&] { encoding->check(soft_images(20)); }).find("divisible by 8, not 20"), std::string::npos);
  SpinImageParams params;
  params.image_width = 16;
  params.convention = SpinConvention::pcl;
  EXPECT_NE(input_error([&] { encoding->check(params); }).find("johnson convention"), std::string::npos);
}

TEST(PooledPyramid, WithoutAnImageIsTheRecipeWithoutIt) {
  Random random(11);
  const SpinImageParams params = soft_images(8);
  const OrientedPoints surface = random_points(50, random);
  for (const std::size_t count : {1U, 4U, 13U}) {  // with 1 and 4 a band loses its only image
    const OrientedPoints spin_points = random_points(count, random);
    const SpinImages images = random_images(count, params.shape(), random);
    const auto object = make_encoding("pooled-pyramid")->begin(surface, spin_points, params);
    std::vector<double> sums(object->size(), 0.0);
    object->accumulate(block_of(images, 0, count), sums);
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t first = k / 3 * 3;  // whatever block it comes in
      const SpinImageBlock block = block_of(images, first, std::min<std::size_t>(3, count - first));
      const std::vector<float> found = object->finish_without(block, k - first, sums).values;
      const std::vector<double> expected = by_recipe(surface, spin_points, images, k);
      ASSERT_EQ(found.size(), expected.size());
      for (std::size_t j = 0; j < found.size(); ++j) {
        ASSERT_NEAR(found[j], expected[j], 2e-6) << count << " points, without " << k << ", feature " << j;
      }
    }
  }
}

TEST(PooledPyramid, SharesOfAllImagesAddUp) {
  Random random(12);
  const SpinImageParams params = soft_images(8);
  const OrientedPoints surface = random_points(50, random);
  const OrientedPoints spin_points = random_points(13, random);
  const SpinImages images = random_images(13, params.shape(), random);
  const auto object = make_encoding("pooled-pyramid")->begin(surface, spin_points, params);
  std::vector<double> sums(object->size(), 0.0);
  object->accumulate(block_of(images, 0, 13), sums);
  const std::vector<float> values = object->finish(sums).values;
  std::vector<float> weights(values.size());
  double product = 0.0;
  for (std::size_t j = 0; j < values.size(); ++j) {
    weights[j] = static_cast<float>(random.normal());
    product += static_cast<double>(weights[j]) * static_cast<double>(values[j]);
  }
  std::vector<double> shares(13, 0.0);
  EXPECT_TRUE(object->add_contributions(block_of(images, 0, 6), sums, weights, shares));
  EXPECT_TRUE(object->add_contributions(block_of(images, 6, 7), sums, weights, shares));
  double sum = 0.0;
  for (const double share : shares) {
    sum += share;
  }
  EXPECT_NEAR(sum, product, 1e-5);
}

TEST(PooledPyramid, AMeanIsSharedByTheRootsAndADeviationByTheirDistances) {
  // Two points of one band (the last of five) with roots 1 and 3 in one bin: mean 2, deviation 1. Of the mean 1 and 3
  // quarters are theirs, of the deviation half each.
  const SpinImageParams params = soft_images(8);
  OrientedPoints spin_points(5);
  for (std::size_t k = 0; k < 5; ++k) {
    spin_points.set(k, Eigen::Vector3f(static_cast<float>(k), 0, 0), Eigen::Vector3f::UnitX());
  }
  SpinImages images(5, params.shape());
  const std::size_t bin = 3 * 8;  // channel 0, row 3, column 0: cell 0 of level 0
  images.image(3)[bin] = 1.0F;
  images.image(4)[bin] = 9.0F;
  const auto object = make_encoding("pooled-pyramid")->begin(OrientedPoints(1), spin_points, params);
  std::vector<double> sums(object->size(), 0.0);
  object->accumulate(block_of(images, 0, 5), sums);
  const std::vector<float> values = object->finish(sums).values;
  const std::size_t mean = 3 * (2 * 2 * 4);  // band 3 of level 0: bands of 2 channels, 2 moments, 4 cells
  const std::size_t deviation = mean + 4;
  ASSERT_NEAR(values[mean], 2.0 / std::sqrt(15.0), 1e-6);  // of length 1 / sqrt(3), 4 + 1 squared
  for (const auto& [feature, first] : {std::pair(mean, 0.25), std::pair(deviation, 0.5)}) {
    std::vector<float> weights(values.size(), 0.0F);
    weights[feature] = 1.0F;
    std::vector<double> shares(5, 0.0);
    ASSERT_TRUE(object->add_contributions(block_of(images, 0, 5), sums, weights, shares));
    EXPECT_NEAR(shares[3], first * static_cast<double>(values[feature]), 1e-6);
    EXPECT_NEAR(shares[4], (1.0 - first) * static_cast<double>(values[feature]), 1e-6);
    EXPECT_EQ(shares[0] + shares[1] + shares[2], 0.0);
  }
}

}  // namespace
}  // namespace spincat
