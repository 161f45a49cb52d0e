#include "spincat/camera/render/sensor_noise.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace spincat {
namespace {

constexpr double kDisparityMetres = 43.5;  // focal length x base line of a Kinect, in pixel metres
constexpr double kDisparityNoise = 0.08;   // pixels
constexpr double kDisparityStep = 0.125;   // pixels
constexpr float kEdge = 0.03F;             // metres of depth between neighbours across an edge
constexpr double kMostSlope = 6.0;         // metres of depth over metres across: 80 degrees
constexpr double kLostAtEdges = 0.5;       // of the pixels there, at strength 1

// Independent noise of each pixel, averaged over 3 x 3: neighbours are correlated, as a sensor's are.
std::vector<float> correlated_noise(const DepthImage& image, double deviation, Random& random) {
  // The mean of nine has a third of their deviation.
  std::vector<float> white(image.depth.size(), 0.0F);
  for (std::size_t i = 0; i < white.size(); ++i) {
    white[i] = image.depth[i] > 0.0F ? static_cast<float>(3.0 * deviation * random.normal()) : 0.0F;
  }
  std::vector<float> noise(white.size(), 0.0F);
  for (int v = 1; v + 1 < image.height; ++v) {
    for (int u = 1; u + 1 < image.width; ++u) {
      float sum = 0.0F;
      for (int dv = -1; dv <= 1; ++dv) {
        for (int du = -1; du <= 1; ++du) {
          sum += white[image.index(u + du, v + dv)];
        }
      }
      noise[image.index(u, v)] = sum / 9.0F;
    }
  }
  return noise;
}

// Whether a sensor may fail to read a pixel: at an edge with something nearer or further, or on a surface seen edge-on.
bool is_hard_to_read(const DepthImage& image, const Intrinsics& intrinsics, int u, int v) {
  const float z = image.at(u, v);
  for (const auto& [du, dv] : {std::array{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
    if (u + du < 0 || v + dv < 0 || u + du >= image.width || v + dv >= image.height) {
      continue;
    }
    const float other = image.at(u + du, v + dv);
    const double slope = std::abs(other - z) * intrinsics.fx / z;
    if (other > 0.0F && (std::abs(other - z) > kEdge || slope > kMostSlope)) {
      return true;
    }
  }
  return false;
}

}  // namespace

void add_sensor_noise(const Intrinsics& intrinsics, double strength, Random& random, DepthImage& image) {
  const DepthImage clean = image;
  const std::vector<float> noise = correlated_noise(clean, strength * kDisparityNoise, random);
  for (int v = 0; v < image.height; ++v) {
    for (int u = 0; u < image.width; ++u) {
      float& z = image.depth[image.index(u, v)];
      if (!(z > 0.0F)) {
        continue;
      }
      const double disparity = kDisparityMetres / static_cast<double>(z) + noise[image.index(u, v)];
      const double rounded = std::round(disparity / kDisparityStep) * kDisparityStep;
      z = rounded > 0.0 ? static_cast<float>(kDisparityMetres / rounded) : 0.0F;
      if (is_hard_to_read(clean, intrinsics, u, v) && random.uniform() < kLostAtEdges * strength) {
        z = 0.0F;
      }
    }
  }
}

}  // namespace spincat
