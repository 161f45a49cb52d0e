// The fast engine: the same numbers as the reference, the same bytes whatever it runs on.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "spin/engines.h"
#include "spincat/error.h"
#include "spincat/spin/spin_image_maker.h"

namespace spincat::test {
namespace {

SpinImageParams random_params(Random& random) {
  SpinImageParams params;
  constexpr std::array kWidths = {1, 2, 3, 5, 7, 8, 10, 15, 16, 17, 20, 31, 40, 64, 100};
  params.image_width = kWidths[random.below(kWidths.size())];
  params.bin_size = std::exp(random.uniform(-3.0, 1.0)) / params.image_width;
  params.support_angle = 180.0 * random.uniform();
  params.binning = random.below(2) == 0 ? Binning::bilinear : Binning::nearest;
  switch (random.below(4)) {
    case 0:
      params.support_angle = 180.0;
      break;
    case 1:
      params.angle_test = AngleTest::soft;
      break;
    case 2:
      params.convention = SpinConvention::pcl;
      params.binning = Binning::bilinear;
      params.support_angle /= 2.0;
      break;
    default:
      break;
  }
  return params;
}

// Positions on a lattice of the bin size, so that very many lie on borders of cells and of the support, among them
// coincident points; normals along axes, zero, or not of length 1.
OrientedPoints lattice_points(std::size_t count, double step, Random& random) {
  OrientedPoints points(count);
  const auto coordinate = [&] { return static_cast<float>(step * (static_cast<double>(random.below(9)) - 4.0)); };
  for (std::size_t i = 0; i < count; ++i) {
    Eigen::Vector3f normal = Eigen::Vector3f::Zero();
    normal[static_cast<int>(random.below(3))] = random.below(2) == 0 ? 1.0F : -1.0F;
    if (random.below(8) == 0) {
      normal *= static_cast<float>(random.below(3));
    }
    points.set(i, {coordinate(), coordinate(), coordinate()}, normal);
  }
  return points;
}

void expect_like_reference(const OrientedPoints& surface, const SpinImageParams& params, std::size_t images) {
  OrientedPoints spin_points(std::min(images, surface.size()));
  for (std::size_t k = 0; k < spin_points.size(); ++k) {
    spin_points.set(k, surface.position(k), surface.normal(k));
  }
  const SpinImages made = make_spin_images(surface, spin_points, params);
  std::vector<float> expected(params.shape().size());
  for (std::size_t k = 0; k < made.count(); ++k) {
    spin_image_reference(surface, spin_points, k, params, expected);
    const float largest = *std::ranges::max_element(expected);
    for (std::size_t i = 0; i < expected.size(); ++i) {
      ASSERT_NEAR(made.image(k)[i], expected[i], 1e-6 * std::max(1.0F, largest))
          << "image " << k << " value " << i << " width " << params.image_width << " bin " << params.bin_size
          << " angle " << params.support_angle;
    }
  }
}

class EngineOnPath : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Paths, EngineOnPath, testing::ValuesIn(simd_paths()),
                         [](const auto& param) { return param.param; });

TEST_P(EngineOnPath, AgreesWithTheReferenceOnRandomCases) {
  const ForcedPath forced(GetParam());
  Random random(7);
  for (int round = 0; round < 300; ++round) {
    const std::size_t count = 1 + random.below(600);
    const OrientedPoints surface = round % 2 == 0 ? bumpy_sphere(count, round) : random_points(count, round);
    expect_like_reference(surface, random_params(random), 3);
  }
}

TEST_P(EngineOnPath, AgreesWithTheReferenceOnBordersAndDegeneratePoints) {
  const ForcedPath forced(GetParam());
  Random random(8);
  for (int round = 0; round < 300; ++round) {
    SpinImageParams params = random_params(random);
    if (round % 2 == 0) {
      params.bin_size = 0.25;  // sums of squares are exact: points lie on the borders, not near them
    }
    expect_like_reference(lattice_points(200, params.bin_size * (round % 3 == 0 ? 0.5 : 1.0), random), params, 3);
  }
}

TEST_P(EngineOnPath, AgreesWithTheReferenceWhereGroupsAreLeftOut) {
  const ForcedPath forced(GetParam());
  Random random(9);
  const OrientedPoints surface = bumpy_sphere(20'000, 9);
  for (int round = 0; round < 40; ++round) {
    expect_like_reference(surface, random_params(random), 4);
  }
}

TEST_P(EngineOnPath, MakesTheLargestImage) {
  const ForcedPath forced(GetParam());
  SpinImageParams params;
  params.image_width = 256;
  params.bin_size = 0.01;
  params.support_angle = 180.0;
  expect_like_reference(bumpy_sphere(3000, 10), params, 2);
  params.angle_test = AngleTest::soft;
  expect_like_reference(bumpy_sphere(3000, 10), params, 2);
  params.angle_test = AngleTest::cutoff;
  params.convention = SpinConvention::pcl;
  params.support_angle = 45.0;
  expect_like_reference(bumpy_sphere(3000, 10), params, 2);
}

std::vector<float> all_images(const OrientedPoints& surface, const SpinImageParams& params, int threads) {
  const SpinImages images = make_spin_images(surface, surface, params, threads);
  return {images.values().begin(), images.values().end()};
}

TEST_P(EngineOnPath, GivesTheSameBytesAsEveryOtherPath) {
  Random random(11);
  const OrientedPoints surface = bumpy_sphere(1500, 11);
  for (int round = 0; round < 20; ++round) {
    const SpinImageParams params = random_params(random);
    const std::vector<float> best = all_images(surface, params, 1);
    const ForcedPath forced(GetParam());
    EXPECT_EQ(all_images(surface, params, 1), best);
  }
}

TEST(SpinImageEngine, GivesTheSameBytesForAnyNumberOfThreads) {
  Random random(12);
  const OrientedPoints surface = bumpy_sphere(1000, 12);
  for (int round = 0; round < 10; ++round) {
    const SpinImageParams params = random_params(random);
    const std::vector<float> one = all_images(surface, params, 1);
    for (const int threads : {2, 3, 8, 40}) {
      EXPECT_EQ(all_images(surface, params, threads), one) << threads;
    }
  }
}

TEST(SpinImageEngine, GivesTheSameBytesWhenThreadsShareOutTheSurface) {
  const OrientedPoints surface = bumpy_sphere(60'000, 13);
  const OrientedPoints few = bumpy_sphere(20, 14);
  Random random(13);
  for (int round = 0; round < 10; ++round) {
    const SpinImageParams params = random_params(random);
    const SpinImageMaker maker(surface, params);
    std::vector<float> one(few.size() * params.shape().size());
    maker.make(few, 0, one);
    std::vector<float> shared(one.size());
    for (const int threads : {2, 3, 50}) {
      maker.make(few, 0, shared, threads);
      EXPECT_EQ(shared, one) << threads;
    }
    const SpinImages chosen = make_spin_images(surface, few, params, 2);
    EXPECT_TRUE(std::ranges::equal(chosen.values(), one));
  }
}

TEST(SpinImageEngine, AnImageDoesNotDependOnItsBlock) {
  const OrientedPoints surface = bumpy_sphere(500, 15);
  const SpinImageParams params;
  const SpinImages all = make_spin_images(surface, surface, params);
  const SpinImageMaker maker(surface, params);
  std::vector<float> some(30 * params.shape().size());
  maker.make(surface, 123, some);
  EXPECT_TRUE(std::ranges::equal(some, all.values().subspan(123 * params.shape().size(), some.size())));
}

TEST(SpinImageEngine, HandsOnBlocksInOrder) {
  const OrientedPoints surface = bumpy_sphere(1000, 16);
  for (const int threads : {1, 4}) {
    std::size_t next = 0;
    make_spin_images(
        surface, surface, {},
        [&](const SpinImageBlock& block) {
          EXPECT_EQ(block.first, next);
          EXPECT_EQ(block.images.count(), std::min(kSpinImageBlock, surface.size() - next));
          next += block.images.count();
        },
        threads);
    EXPECT_EQ(next, surface.size());
  }
}

TEST(SpinImageEngine, NoSpinPointsGiveNoBlocks) {
  make_spin_images(
      bumpy_sphere(100, 17), OrientedPoints(0), {}, [](const SpinImageBlock&) { FAIL(); }, 2);
}

TEST(SpinImageEngine, WhatTheConsumerThrowsArrives) {
  const OrientedPoints surface = bumpy_sphere(2000, 18);
  for (const int threads : {1, 2, 5}) {
    int calls = 0;
    const auto consume = [&](const SpinImageBlock&) {
      if (++calls == 3) {
        throw std::runtime_error("disk full");
      }
    };
    EXPECT_THROW(make_spin_images(surface, surface, {}, consume, threads), std::runtime_error);
    EXPECT_EQ(calls, 3);
  }
}

TEST(SpinImageEngine, RefusesAnUnknownPath) {
  const ForcedPath forced("mmx");
  try {
    make_spin_images(bumpy_sphere(10, 19), bumpy_sphere(10, 19), {});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(error.problem().find("'mmx'"), std::string::npos);
    EXPECT_NE(error.problem().find(simd_paths().back()), std::string::npos);
  }
}

}  // namespace
}  // namespace spincat::test
