// Organized clouds as the depth pictures that they were made of.
#pragma once

#include "spincat/camera/source/frame_source.h"
#include "spincat/io/organized_cloud.h"

namespace spincat {

// The depths along z and the camera, which the points tell. Where every z is negative, z points towards the camera (y
// up, as in pictures of computers) and depths are -z. Throws InputError (without a file name) where points lie before
// and behind the camera, or are those of no pinhole camera.
Frame frame_of_cloud(const OrganizedCloud& cloud);

}  // namespace spincat
