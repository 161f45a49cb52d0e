// From an object's pixels to the point cloud that is described and judged.
#pragma once

#include <cstddef>

#include "spincat/camera/segment/segment.h"
#include "spincat/camera/segment/table.h"
#include "spincat/camera/source/frame_source.h"
#include "spincat/geometry/object.h"

namespace spincat {

inline constexpr std::size_t kMostCloudPoints = 2'048;

// The points of one object with their normals, as a cloud that stands on the table: in metres, z up, the sensor where
// it was. At most kMostCloudPoints pixels are taken, evenly in the order of rows. Normals are those of the plane
// through the object's points within 9 mm (of pixels, both ways), whose depth agrees; they point to the sensor. Pixels
// too lonely for a plane are left out. Deterministic.
PointCloud segment_cloud(const DepthImage& image, const Intrinsics& intrinsics, const SupportPlane& table,
                         const Segmentation& segmentation, const Segment& segment);

}  // namespace spincat
