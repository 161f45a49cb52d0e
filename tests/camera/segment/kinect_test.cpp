// Real pictures of a Kinect with every pixel's object known: shared data that SPINCAT_KINECT points to (a folder that
// holds mosd-dev/).
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "spincat/camera/segment/segment.h"
#include "spincat/camera/segment/table.h"
#include "spincat/camera/source/calibration.h"
#include "spincat/camera/source/depth_png.h"
#include "spincat/files/file.h"

namespace spincat {
namespace {

namespace fs = std::filesystem;

constexpr double kLeastPixels = 300.0;  // of a labelled part that is counted
constexpr int kFirstObject = 20;        // labels below are the table's

// For each labelled part of a scene the best intersection over union with an object that was found.
std::vector<double> agreements(const fs::path& scene, const CameraCalibration& calibration) {
  const DepthImage image =
      decode_depth_png(read_file(scene / "depth.png"), calibration.units_per_metre.value_or(kUsualUnits));
  const DepthImage labels = decode_depth_png(read_file(scene / "label.png"), 1.0);
  const std::optional<SupportPlane> table = find_table(image, calibration.intrinsics, {});
  if (!table) {
    ADD_FAILURE() << scene << ": no table";
    return {};
  }
  SegmentSettings settings;
  settings.split = SegmentSplit::concave;
  const Segmentation found = segment(image, calibration.intrinsics, *table, settings);
  std::map<int, double> pixels;
  std::map<std::pair<int, int>, double> shared;
  for (std::size_t i = 0; i < labels.depth.size(); ++i) {
    const int label = static_cast<int>(labels.depth[i]);
    pixels[label] += 1.0;
    shared[{label, found.ids[i]}] += 1.0;
  }
  std::vector<double> best;
  for (const auto& [label, count] : pixels) {
    if (label < kFirstObject || count < kLeastPixels) {
      continue;
    }
    best.push_back(0.0);
    for (const Segment& object : found.objects) {
      const double both = shared[{label, object.id}];
      best.back() = std::max(best.back(), both / (count + static_cast<double>(object.pixels) - both));
    }
  }
  return best;
}

TEST(Kinect, PartsOfRealScenesAreFound) {
  const char* data = std::getenv("SPINCAT_KINECT");
  if (data == nullptr) {
    GTEST_SKIP() << "SPINCAT_KINECT does not name the folder that holds mosd-dev/";
  }
  const fs::path folder = fs::path(data) / "mosd-dev";
  const CameraCalibration calibration = read_calibration(folder / "camera.txt");
  std::vector<double> best;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.is_directory()) {
      const std::vector<double> scene = agreements(entry.path(), calibration);
      best.insert(best.end(), scene.begin(), scene.end());
    }
  }
  ASSERT_EQ(best.size(), 31U);
  const auto share_above = [&](double least) {
    return static_cast<double>(std::ranges::count_if(best, [&](double b) { return b >= least; })) /
           static_cast<double>(best.size());
  };
  EXPECT_GE(share_above(0.5), 0.93);
  EXPECT_GE(share_above(0.75), 0.86);
}

}  // namespace
}  // namespace spincat
