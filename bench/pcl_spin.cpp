#include "pcl_spin.h"

#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>

#include <pcl/features/impl/spin_image.hpp>

namespace spincat::bench {

using Cloud = pcl::PointCloud<pcl::PointXYZ>;
using Normals = pcl::PointCloud<pcl::Normal>;
using Tree = pcl::search::KdTree<pcl::PointXYZ>;

struct PclSpinImages::Data {
  Cloud::Ptr cloud{new Cloud};
  Normals::Ptr normals{new Normals};
  Tree::Ptr tree{new Tree(false)};  // false: neighbours need not be sorted
};

PclSpinImages::PclSpinImages(const OrientedPoints& surface) : data_(std::make_unique<Data>()) {
  for (std::size_t i = 0; i < surface.size(); ++i) {
    data_->cloud->push_back(pcl::PointXYZ(surface.x()[i], surface.y()[i], surface.z()[i]));
    data_->normals->push_back(pcl::Normal(surface.nx()[i], surface.ny()[i], surface.nz()[i]));
  }
  data_->tree->setInputCloud(data_->cloud);
}

PclSpinImages::~PclSpinImages() = default;

namespace {

template <int kWidth, class Data>
double run_width(const Data& data, const std::vector<int>& chosen, double search_radius, double least_cosine) {
  using Image = pcl::Histogram<(kWidth + 1) * (2 * kWidth + 1)>;
  pcl::SpinImageEstimation<pcl::PointXYZ, pcl::Normal, Image> estimation(kWidth, least_cosine, 0);
  estimation.setInputCloud(data.cloud);
  estimation.setInputNormals(data.normals);
  estimation.setSearchMethod(data.tree);
  estimation.setRadiusSearch(search_radius);
  if (!chosen.empty()) {
    estimation.setIndices(pcl::IndicesPtr(new pcl::Indices(chosen.begin(), chosen.end())));
  }
  pcl::PointCloud<Image> images;
  estimation.compute(images);
  double sum = 0.0;
  for (const Image& image : images) {
    sum += image.histogram[kWidth];
  }
  return sum;
}

}  // namespace

double PclSpinImages::run(const std::vector<int>& chosen, int image_width, double search_radius,
                          double least_cosine) const {
  return image_width == 10 ? run_width<10>(*data_, chosen, search_radius, least_cosine)
                           : run_width<20>(*data_, chosen, search_radius, least_cosine);
}

}  // namespace spincat::bench
