// The pcl convention against images made by PCL 1.13 itself (bench/pcl_golden.cpp).
#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

#include "spin/engines.h"

namespace spincat::test {
namespace {

struct GoldenCase {
  SpinImageParams params;
  std::vector<std::vector<float>> images;  // of the first points
};

struct Golden {
  OrientedPoints surface;
  std::vector<GoldenCase> cases;
};

Golden read_golden() {
  std::ifstream in(SPINCAT_TEST_DATA "/spin/pcl_golden.txt");
  std::string word;
  std::size_t count = 0;
  in >> word >> count;
  Golden golden{OrientedPoints(count), {}};
  for (std::size_t i = 0; i < count; ++i) {
    Eigen::Vector3f p;
    Eigen::Vector3f n;
    in >> p.x() >> p.y() >> p.z() >> n.x() >> n.y() >> n.z();
    golden.surface.set(i, p, n);
  }
  double radius = 0.0;
  SpinImageParams params;
  params.convention = SpinConvention::pcl;
  while (in >> word >> params.image_width >> radius >> params.support_angle >> count) {
    params.bin_size = pcl_bin_size(radius, params.image_width);
    GoldenCase& made = golden.cases.emplace_back(GoldenCase{params, {}});
    for (std::size_t k = 0; k < count; ++k) {
      for (float& value : made.images.emplace_back(params.shape().size())) {
        in >> value;
      }
    }
  }
  return golden;
}

class PclGolden : public testing::TestWithParam<Engine> {};
INSTANTIATE_TEST_SUITE_P(Engines, PclGolden, testing::ValuesIn(engines()),
                         [](const auto& param) { return param.param.name; });

TEST_P(PclGolden, AgreesToAMillionth) {
  const Golden golden = read_golden();
  ASSERT_EQ(golden.cases.size(), 4U);
  for (const GoldenCase& made : golden.cases) {
    for (std::size_t k = 0; k < made.images.size(); ++k) {
      const OrientedPoint spin{golden.surface.position(k), golden.surface.normal(k)};
      const std::vector<float> image = GetParam().image(golden.surface, spin, made.params);
      for (std::size_t i = 0; i < image.size(); ++i) {
        EXPECT_NEAR(image[i], made.images[k][i], 1e-6) << "width " << made.params.image_width << " image " << k;
      }
    }
  }
}

}  // namespace
}  // namespace spincat::test
