// The background shapes to look at: sheet.png with all of them, and an OFF file for each.
//
//   background_shapes FOLDER
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <iterator>
#include <string>

#include "spincat/background/background_shapes.h"
#include "spincat/camera/render/render.h"
#include "spincat/camera/source/frame_source.h"
#include "spincat/files/file.h"
#include "spincat/report/picture.h"

namespace {

using namespace spincat;  // NOLINT(google-build-using-namespace)

constexpr int kSide = 110;  // pixels of one shape
constexpr std::size_t kColumns = 16;

std::string off_text(const Mesh& mesh) {
  std::string text = fmt::format("OFF\n{} {} 0\n", mesh.vertices.size(), mesh.triangles.size());
  for (const Vec3& v : mesh.vertices) {
    fmt::format_to(std::back_inserter(text), "{} {} {}\n", v.x(), v.y(), v.z());
  }
  for (const Triangle& t : mesh.triangles) {
    fmt::format_to(std::back_inserter(text), "3 {} {} {}\n", t[0], t[1], t[2]);
  }
  return text;
}

// The mesh in front of the camera, seen a little from above, four times its radius away.
Mesh in_sight(Mesh mesh) {
  Vec3 low = mesh.vertices.front();
  Vec3 high = low;
  for (const Vec3& v : mesh.vertices) {
    low = low.cwiseMin(v);
    high = high.cwiseMax(v);
  }
  const Vec3 centre = 0.5 * (low + high);
  double radius = 0.0;
  for (const Vec3& v : mesh.vertices) {
    radius = std::max(radius, (v - centre).norm());
  }
  const Eigen::Matrix3d turn =
      (Eigen::AngleAxisd(-1.15, Vec3::UnitX()) * Eigen::AngleAxisd(0.6, Vec3::UnitZ())).toRotationMatrix();
  for (Vec3& v : mesh.vertices) {
    const Vec3 seen = turn * (v - centre) / radius;
    v = Vec3(seen.x(), -seen.y(), 4.0 - seen.z());
  }
  return mesh;
}

// How bright a pixel is, from how the depth changes towards the pixels beside it.
std::uint8_t brightness(const DepthImage& image, int u, int v) {
  const double z = image.at(u, v);
  const auto slope = [&](double beside) { return beside > 0.0 ? 0.5 * kSide * (z - beside) : 5.0; };
  const Vec3 normal = Vec3(slope(image.at(u - 1, v)), slope(image.at(u, v - 1)), 1.0).normalized();
  return static_cast<std::uint8_t>(230.0 * (0.25 + 0.7 * std::abs(normal.dot(Vec3(0.4, 0.5, 0.77)))));
}

void draw(const Mesh& mesh, std::size_t number, GreyPicture& sheet) {
  DepthImage image(kSide, kSide);
  draw_depth(in_sight(mesh), {1.9 * kSide, 1.9 * kSide, 0.5 * kSide, 0.5 * kSide}, image);
  const std::size_t left = number % kColumns * kSide;
  const std::size_t top = number / kColumns * kSide;
  for (int v = 1; v < kSide; ++v) {
    for (int u = 1; u < kSide; ++u) {
      if (image.at(u, v) > 0.0F) {
        const std::size_t row = top + static_cast<std::size_t>(v);
        sheet.values[row * sheet.width + left + static_cast<std::size_t>(u)] = brightness(image, u, v);
      }
    }
  }
}

void write_all(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  GreyPicture sheet;
  sheet.width = kColumns * kSide;
  sheet.height = (kBackgroundShapes + kColumns - 1) / kColumns * kSide;
  sheet.values.assign(sheet.width * sheet.height, 255);
  for (std::uint32_t number = 0; number < kBackgroundShapes; ++number) {
    const Mesh mesh = background_shape(number);
    write_file_atomically(folder / fmt::format("{:03}.off", number), off_text(mesh));
    draw(mesh, number, sheet);
  }
  write_file_atomically(folder / "sheet.png", encode_png(sheet));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "usage: background_shapes FOLDER\n");
    return 2;
  }
  try {
    write_all(argv[1]);
  } catch (const std::exception& e) {
    fmt::print(stderr, "background_shapes: {}\n", e.what());
    return 1;
  }
  return 0;
}
