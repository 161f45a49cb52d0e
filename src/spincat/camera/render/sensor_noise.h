// Rendered pictures that look like a real sensor's.
#pragma once

#include "spincat/camera/source/frame_source.h"
#include "spincat/geometry/random.h"

namespace spincat {

// Makes a rendered picture look like one of a structured-light sensor (Kinect): noise of the disparity, correlated
// between neighbours, which is then rounded to 1/8 pixel, and no readings at edges and at grazing angles. `strength` 1
// nearly fits a Kinect: a plane's readings scatter by 1 mm at .7 m and 3 mm at 1.35 m; 0 only rounds. Deterministic for
// one state of `random`.
void add_sensor_noise(const Intrinsics& intrinsics, double strength, Random& random, DepthImage& image);

}  // namespace spincat
