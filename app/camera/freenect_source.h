// Frames of a Kinect (the first generation), where spincat was built with libfreenect.
#pragma once

#include <memory>

#include "spincat/camera/source/frame_source.h"

namespace spincat::app {

// Whether this spincat was built with libfreenect.
bool has_kinect();

// The first Kinect that is found, as long as it delivers. Without a calibration the numbers of its depth camera. Throws
// InputError when spincat was built without libfreenect, RunError when there is no Kinect.
std::unique_ptr<FrameSource> open_kinect(const FrameSettings& settings);

}  // namespace spincat::app
