// Makes tests/data/spin/pcl_golden.txt: spin images of a small surface by pcl::SpinImageEstimation, against which the
// pcl convention is tested. Built with SPINCAT_BENCH where PCL is installed (made with PCL 1.13.0).
//
//   spincat_pcl_golden > tests/data/spin/pcl_golden.txt
#include <pcl/point_types.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <pcl/features/impl/spin_image.hpp>
#include <random>

namespace {

constexpr int kPoints = 120;
constexpr int kImages = 4;

using Cloud = pcl::PointCloud<pcl::PointXYZ>;
using Normals = pcl::PointCloud<pcl::Normal>;

// An ellipsoid with noise on its normals, in full single precision: no point lies on an edge of a cell.
void make_surface(Cloud& cloud, Normals& normals) {
  std::mt19937 engine(13);
  const auto uniform = [&] { return static_cast<float>(engine() >> 8) * 0x1.0p-23F - 1.0F; };
  for (int i = 0; i < kPoints; ++i) {
    const Eigen::Vector3f n = Eigen::Vector3f(uniform(), uniform(), uniform()).normalized();
    const Eigen::Vector3f m = (n + 0.3F * Eigen::Vector3f(uniform(), uniform(), uniform())).normalized();
    cloud.push_back(pcl::PointXYZ(n.x(), 0.8F * n.y(), 0.6F * n.z()));
    normals.push_back(pcl::Normal(m.x(), m.y(), m.z()));
  }
}

template <int kWidth>
void print_case(const Cloud::Ptr& cloud, const Normals::Ptr& normals, double radius, double degrees) {
  constexpr int kValues = (kWidth + 1) * (2 * kWidth + 1);
  using Image = pcl::Histogram<kValues>;
  // 90 degrees as exactly zero: the cosine of a rounded right angle is not.
  const double least_cosine = degrees == 90.0 ? 0.0 : std::cos(degrees * M_PI / 180.0);
  pcl::SpinImageEstimation<pcl::PointXYZ, pcl::Normal, Image> estimation(kWidth, least_cosine, 0);
  estimation.setInputCloud(cloud);
  estimation.setInputNormals(normals);
  estimation.setRadiusSearch(radius);
  pcl::PointCloud<Image> images;
  estimation.compute(images);
  std::printf("case %d %.17g %g %d\n", kWidth, radius, degrees, kImages);
  for (int k = 0; k < kImages; ++k) {
    for (int i = 0; i < kValues; ++i) {
      std::printf("%.9g%c", static_cast<double>(images[k].histogram[i]), i + 1 < kValues ? ' ' : '\n');
    }
  }
}

}  // namespace

int main() {
  const auto cloud = std::make_shared<Cloud>();
  const auto normals = std::make_shared<Normals>();
  make_surface(*cloud, *normals);
  std::printf("points %d\n", kPoints);
  for (int i = 0; i < kPoints; ++i) {
    const auto& p = (*cloud)[i];
    const auto& n = (*normals)[i];
    std::printf("%.9g %.9g %.9g %.9g %.9g %.9g\n", p.x, p.y, p.z, n.normal_x, n.normal_y, n.normal_z);
  }
  print_case<4>(cloud, normals, 1.0, 90.0);
  print_case<8>(cloud, normals, 0.7, 60.0);
  print_case<8>(cloud, normals, 5.0, 90.0);
  print_case<10>(cloud, normals, 3.0, 30.0);
}
