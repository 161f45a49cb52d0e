// The definition of a spin image, on points whose places in the image are known exactly.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include "spin/engines.h"
#include "spincat/error.h"

namespace spincat::test {
namespace {

const OrientedPoint kOriginUp{{0.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 1.0F}};

// What a cell is expected to hold; all others are expected to hold nothing.
struct Cell {
  std::size_t row;
  std::size_t column;
  float value;
};

class SpinImageDefinition : public testing::TestWithParam<Engine> {
 protected:
  std::vector<float> image(const OrientedPoints& surface, const SpinImageParams& params,
                           const OrientedPoint& spin = kOriginUp) const {
    return GetParam().image(surface, spin, params);
  }

  void expect_cells(const OrientedPoints& surface, const SpinImageParams& params,
                    const std::vector<Cell>& cells) const {
    std::vector<float> expected(params.shape().size(), 0.0F);
    for (const Cell& cell : cells) {
      expected[cell.row * params.shape().columns + cell.column] = cell.value;
    }
    EXPECT_EQ(image(surface, params), expected);
  }

  void expect_empty(const OrientedPoints& surface, const SpinImageParams& params) const {
    expect_cells(surface, params, {});
  }
};

INSTANTIATE_TEST_SUITE_P(Engines, SpinImageDefinition, testing::ValuesIn(engines()),
                         [](const auto& param) { return param.param.name; });

// alpha = 1.25 (a 3-4-5 triangle), beta = 0.5.
const OrientedPoints kPoint = points_of({{{0.75F, 1.0F, 0.5F}}});

TEST_P(SpinImageDefinition, SharesAPointBetweenFourCells) {
  expect_cells(kPoint, johnson4(), {{1, 1, 0.375F}, {2, 1, 0.375F}, {1, 2, 0.125F}, {2, 2, 0.125F}});
}

TEST_P(SpinImageDefinition, PclPutsTheSamePointIntoRowsOfAlpha) {
  expect_cells(kPoint, pcl4(), {{1, 4, 0.375F}, {2, 4, 0.125F}, {1, 5, 0.375F}, {2, 5, 0.125F}});
}

TEST_P(SpinImageDefinition, NearestBinningGivesAllToOneCell) {
  SpinImageParams params = johnson4();
  params.binning = Binning::nearest;
  expect_cells(kPoint, params, {{1, 1, 1.0F}});
}

TEST_P(SpinImageDefinition, APointOnACellsCornerFillsThatCellOnly) {
  const OrientedPoints corner = points_of({{{1.0F, 0.0F, 1.0F}}});
  expect_cells(corner, johnson4(), {{1, 1, 1.0F}});
  expect_cells(corner, pcl4(), {{1, 5, 1.0F}});
}

TEST_P(SpinImageDefinition, TopBorderBelongsToTheSupportAndBottomDoesNot) {
  expect_cells(points_of({{{1.0F, 0.0F, 2.0F}}}), johnson4(), {{0, 1, 1.0F}});
  expect_empty(points_of({{{1.0F, 0.0F, -2.0F}}}), johnson4());
  expect_empty(points_of({{{1.0F, 0.0F, std::nextafter(2.0F, 3.0F)}}}), johnson4());
}

TEST_P(SpinImageDefinition, OuterBorderDoesNotBelongToTheSupport) {
  expect_empty(points_of({{{4.0F, 0.0F, 0.0F}}}), johnson4());
  expect_cells(points_of({{{3.0F, 0.0F, 0.0F}}}), johnson4(), {{2, 3, 1.0F}});
  for (const OrientedPoints& outside :
       {points_of({{{4.0F, 0.0F, 0.0F}}}), points_of({{{1.0F, 0.0F, 4.0F}}}), points_of({{{1.0F, 0.0F, -4.0F}}})}) {
    expect_empty(outside, pcl4());
  }
}

TEST_P(SpinImageDefinition, TapsOutsideTheImageAreDropped) {
  // column 3.5: half of the weight lies beyond the last column; row 3.5 likewise
  expect_cells(points_of({{{3.5F, 0.0F, 0.0F}}}), johnson4(), {{2, 3, 0.5F}});
  expect_cells(points_of({{{3.5F, 0.0F, -1.5F}}}), johnson4(), {{3, 3, 0.25F}});
}

TEST_P(SpinImageDefinition, PclKeepsEveryTap) {
  expect_cells(points_of({{{3.5F, 0.0F, -3.5F}}}), pcl4(),
               {{3, 0, 0.25F}, {4, 0, 0.25F}, {3, 1, 0.25F}, {4, 1, 0.25F}});
}

TEST_P(SpinImageDefinition, SupportAngleIsSigned) {
  const OrientedPoints same = points_of({{{1.0F, 0.0F, 1.0F}, {0.0F, 0.0F, 1.0F}}});
  const OrientedPoints across = points_of({{{1.0F, 0.0F, 1.0F}, {1.0F, 0.0F, 0.0F}}});
  const OrientedPoints opposite = points_of({{{1.0F, 0.0F, 1.0F}, {0.0F, 0.0F, -1.0F}}});
  const std::vector<Cell> all = {{1, 1, 1.0F}};
  expect_cells(same, johnson4(0.0), all);
  expect_cells(same, johnson4(60.0), all);
  expect_empty(across, johnson4(60.0));
  expect_empty(across, johnson4(89.0));
  expect_cells(across, johnson4(90.0), all);
  expect_empty(opposite, johnson4(90.0));
  expect_empty(opposite, johnson4(179.0));
  expect_cells(opposite, johnson4(180.0), all);
}

TEST_P(SpinImageDefinition, PclSupportAngleIgnoresTheSign) {
  const std::vector<Cell> all = {{1, 5, 1.0F}};
  expect_cells(points_of({{{1.0F, 0.0F, 1.0F}, {0.0F, 0.0F, -1.0F}}}), pcl4(60.0), all);
  expect_empty(points_of({{{1.0F, 0.0F, 1.0F}, {1.0F, 0.0F, 0.0F}}}), pcl4(60.0));
  expect_cells(points_of({{{1.0F, 0.0F, 1.0F}, {1.0F, 0.0F, 0.0F}}}), pcl4(90.0), all);
}

TEST_P(SpinImageDefinition, APointWithinTheSupportAngleIsKeptAtItsExactCosine) {
  // n . m = 0.5 = cos 60: on the border, which belongs to the support
  const OrientedPoints at60 = points_of({{{1.0F, 0.0F, 1.0F}, {std::sqrt(0.75F), 0.0F, 0.5F}}});
  expect_cells(at60, johnson4(60.0), {{1, 1, 1.0F}});
  expect_empty(at60, johnson4(59.9));
}

TEST_P(SpinImageDefinition, SpinPointTakesPartInItsOwnImage) {
  expect_cells(points_of({kOriginUp}), johnson4(), {{2, 0, 1.0F}});
}

TEST_P(SpinImageDefinition, PclLeavesTheSpinPointOut) {
  expect_empty(points_of({kOriginUp}), pcl4());
  expect_cells(points_of({kOriginUp, {{1.0F, 0.0F, 1.0F}}}), pcl4(), {{1, 5, 1.0F}});
}

TEST_P(SpinImageDefinition, NoPointsGiveAnEmptyImage) {
  expect_empty(OrientedPoints(0), johnson4());
  expect_empty(OrientedPoints(0), pcl4());
}

TEST_P(SpinImageDefinition, SoftAngleSplitsEachPointByItsSquaredCosine) {
  SpinImageParams params = johnson4();
  params.angle_test = AngleTest::soft;
  params.binning = Binning::nearest;
  const std::vector<float> two = image(points_of({{{1.0F, 0.0F, 1.0F}, {std::sqrt(0.75F), 0.0F, -0.5F}}}), params);
  ASSERT_EQ(two.size(), 32U);
  EXPECT_EQ(two[5], 0.25F);
  EXPECT_EQ(two[16 + 5], 0.75F);
  EXPECT_EQ(sum(two), 1.0);
}

TEST_P(SpinImageDefinition, SoftChannelsSumToTheOneChannelImage) {
  const OrientedPoints surface = random_points(500, 1);
  for (const Binning binning : {Binning::bilinear, Binning::nearest}) {
    SpinImageParams params = johnson4();
    params.bin_size = 0.3;
    params.binning = binning;
    const std::vector<float> one = image(surface, params);
    params.angle_test = AngleTest::soft;
    const std::vector<float> two = image(surface, params);
    for (std::size_t i = 0; i < one.size(); ++i) {
      EXPECT_NEAR(two[i] + two[one.size() + i], one[i], 1e-5) << i;
    }
  }
}

TEST_P(SpinImageDefinition, PlaneFillsTheRowOfItsHeight) {
  // rings of 8 points at radii 0.5, 1.5, 2.5: a plane through the spin point
  std::vector<OrientedPoint> plane;
  for (const float radius : {0.5F, 1.5F, 2.5F}) {
    for (const auto& [x, y] : {std::pair{1.0F, 0.0F},
                               {-1.0F, 0.0F},
                               {0.0F, 1.0F},
                               {0.0F, -1.0F},
                               {0.6F, 0.8F},
                               {-0.6F, 0.8F},
                               {0.8F, -0.6F},
                               {-0.8F, -0.6F}}) {
      plane.push_back({{radius * x, radius * y, 0.0F}});
    }
  }
  const std::vector<float> result = image(points_of(plane), johnson4());
  const std::vector<float> row = {4.0F, 8.0F, 8.0F, 4.0F};
  for (std::size_t i = 0; i < result.size(); ++i) {
    EXPECT_NEAR(result[i], i / 4 == 2 ? row[i % 4] : 0.0F, 1e-5) << i;
  }
}

TEST_P(SpinImageDefinition, CylinderSeenFromItsAxisFillsOneColumn) {
  std::vector<OrientedPoint> cylinder;
  for (const float height : {-1.0F, 0.0F, 1.0F, 2.0F}) {
    for (int k = 0; k < 10; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / 10;
      const Eigen::Vector3f out(static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)), 0.0F);
      cylinder.push_back({2.0F * out + Eigen::Vector3f(0.0F, 0.0F, height), out});
    }
  }
  const std::vector<float> result = image(points_of(cylinder), johnson4());
  for (std::size_t i = 0; i < result.size(); ++i) {
    EXPECT_NEAR(result[i], i % 4 == 2 ? 10.0F : 0.0F, 1e-5) << i;  // beta 2, 1, 0, -1 are rows 0, 1, 2, 3
  }
}

TEST_P(SpinImageDefinition, SphereSeenFromItsPoleLiesOnACircle) {
  // alpha^2 + (beta + r)^2 = r^2, and the circle of latitude t at alpha = r sin t, beta = r (cos t - 1)
  SpinImageParams params = johnson4();
  params.image_width = 10;
  params.bin_size = 0.5;
  constexpr double kRadius = 1.0;
  const OrientedPoint pole{{0.0F, 0.0F, 1.0F}};
  for (const double t : {0.2, 0.7, 1.3, 2.0, 2.8}) {
    std::vector<OrientedPoint> ring;
    for (int k = 0; k < 12; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / 12;
      const Eigen::Vector3d n(std::sin(t) * std::cos(angle), std::sin(t) * std::sin(angle), std::cos(t));
      ring.push_back({(kRadius * n).cast<float>(), n.cast<float>()});
    }
    const std::vector<float> result = image(points_of(ring), params, pole);
    const double row = 5.0 - kRadius * (std::cos(t) - 1.0) / 0.5;
    const double column = kRadius * std::sin(t) / 0.5;
    double mean_row = 0.0;
    double mean_column = 0.0;
    for (std::size_t i = 0; i < result.size(); ++i) {
      mean_row += result[i] * static_cast<double>(i / 10) / 12.0;
      mean_column += result[i] * static_cast<double>(i % 10) / 12.0;
    }
    EXPECT_NEAR(sum(result), 12.0, 1e-4);
    EXPECT_NEAR(mean_row, row, 1e-4);  // bilinear sharing keeps the centre of gravity
    EXPECT_NEAR(mean_column, column, 1e-4);
  }
}

TEST_P(SpinImageDefinition, WeightIsConserved) {
  const OrientedPoints surface = random_points(1000, 2);
  SpinImageParams params = johnson4();
  params.image_width = 20;
  params.bin_size = 0.5;  // everything lies well inside
  EXPECT_NEAR(sum(image(surface, params)), 1000.0, 1e-3);
  params.convention = SpinConvention::pcl;
  params.support_angle = 90.0;
  EXPECT_NEAR(sum(image(surface, params)), 1.0, 1e-6);  // normalised
}

TEST_P(SpinImageDefinition, TurningTheObjectChangesNothing) {
  const OrientedPoints surface = random_points(400, 3);
  SpinImageParams params = johnson4();
  params.image_width = 16;
  params.bin_size = 0.5;
  const Eigen::Matrix3f rotation =
      Eigen::AngleAxisf(1.1F, Eigen::Vector3f(1.0F, -2.0F, 0.5F).normalized()).toRotationMatrix();
  for (std::size_t k = 0; k < 5; ++k) {
    const OrientedPoint spin{surface.position(k), surface.normal(k)};
    const std::vector<float> before = image(surface, params, spin);
    const std::vector<float> after =
        image(turned(surface, rotation), params, {rotation * spin.position, rotation * spin.normal});
    for (std::size_t i = 0; i < before.size(); ++i) {
      EXPECT_NEAR(after[i], before[i], 2e-3) << i;
    }
  }
}

TEST_P(SpinImageDefinition, PointsThatAreNoPlacesAreLeftOut) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float inf = std::numeric_limits<float>::infinity();
  const OrientedPoints surface = points_of({{{nan, 0.0F, 0.0F}},
                                            {{0.0F, nan, 1.0F}},
                                            {{inf, 0.0F, 0.0F}},
                                            {{1.0F, 0.0F, 1.0F}},
                                            {{0.0F, 0.0F, -inf}},
                                            {{1e30F, 0.0F, 0.0F}}});
  expect_cells(surface, johnson4(), {{1, 1, 1.0F}});
  expect_cells(surface, pcl4(), {{1, 5, 1.0F}});
}

}  // namespace
}  // namespace spincat::test
