// What judges learn from that will look through a depth camera: rendered views of models.
#pragma once

#include <cstdint>

#include "spincat/camera/segment/segment.h"
#include "spincat/geometry/object.h"

namespace spincat {

// How models are looked at. Everything is drawn uniformly from its range for each view.
struct ViewSettings {
  UpAxis up = UpAxis::y;     // of the models; not none
  double least_size = 0.15;  // of the model's largest extent, in metres
  double most_size = 0.35;
  double least_distance = 0.8;  // from the camera to the model, in metres
  double most_distance = 1.5;
  double least_elevation = 20.0;  // of the camera over the table, in degrees
  double most_elevation = 60.0;
  double most_noise = 1.5;  // strength of the sensor's noise; the least is 0
  SegmentSettings segment;

  // Throws InputError naming the field, its value and the allowed range.
  void validate() const;
};

// A view of a model that stands on a table, turned at random about the vertical: rendered as a Kinect would see it, cut
// out and given normals by the same steps as at run time (segment_cloud). Deterministic. Throws InputError (without a
// file name) when the camera sees nothing of the model, or too little to be an object.
PointCloud view_of(const Mesh& model, const ViewSettings& settings, std::uint64_t seed);

}  // namespace spincat
