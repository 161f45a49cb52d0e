#include "spincat/spin/params.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "spincat/error.h"

namespace spincat {
namespace {

std::string complaint(const SpinImageParams& params) {
  try {
    params.validate();
  } catch (const InputError& error) {
    return error.problem();
  }
  return "";
}

TEST(SpinImageParams, DefaultsAreValid) {
  EXPECT_EQ(complaint({}), "");
}

TEST(SpinImageParams, RefusesAnImageWidthOutOfRange) {
  SpinImageParams params;
  for (const int width : {0, -1, 257}) {
    params.image_width = width;
    EXPECT_NE(complaint(params).find("image_width"), std::string::npos) << width;
  }
  for (const int width : {1, 256}) {
    params.image_width = width;
    EXPECT_EQ(complaint(params), "") << width;
  }
}

TEST(SpinImageParams, RefusesABinSizeOutOfRange) {
  SpinImageParams params;
  for (const double size :
       {0.0, -1.0, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    params.bin_size = size;
    EXPECT_NE(complaint(params).find("bin_size"), std::string::npos) << size;
  }
}

TEST(SpinImageParams, RefusesASupportAngleOutOfRange) {
  SpinImageParams params;
  for (const double angle : {-1.0, 180.5, std::numeric_limits<double>::quiet_NaN()}) {
    params.support_angle = angle;
    EXPECT_NE(complaint(params).find("support_angle"), std::string::npos) << angle;
  }
  params.convention = SpinConvention::pcl;
  params.support_angle = 91.0;
  EXPECT_NE(complaint(params).find("0 to 90"), std::string::npos);
}

TEST(SpinImageParams, PclKnowsOnlyBilinearAndCutoff) {
  SpinImageParams params;
  params.convention = SpinConvention::pcl;
  EXPECT_EQ(complaint(params), "");
  params.binning = Binning::nearest;
  EXPECT_NE(complaint(params).find("pcl"), std::string::npos);
  params.binning = Binning::bilinear;
  params.angle_test = AngleTest::soft;
  EXPECT_NE(complaint(params).find("pcl"), std::string::npos);
}

TEST(SpinImageParams, ShapeFollowsTheConvention) {
  SpinImageParams params;
  params.image_width = 8;
  EXPECT_EQ(params.shape(), (SpinImageShape{1, 8, 8}));
  params.angle_test = AngleTest::soft;
  EXPECT_EQ(params.shape(), (SpinImageShape{2, 8, 8}));
  params = {};
  params.convention = SpinConvention::pcl;
  params.image_width = 8;
  EXPECT_EQ(params.shape(), (SpinImageShape{1, 9, 17}));
}

TEST(SpinImageParams, PclBinSizeCoversTheSearchRadius) {
  EXPECT_DOUBLE_EQ(pcl_bin_size(2.0, 10), 2.0 / (10.0 * 1.4142135623730951));
}

}  // namespace
}  // namespace spincat
