// The objects on a table, each as a set of pixels.
#pragma once

#include "spincat/camera/segment/scene.h"
#include "spincat/camera/source/frame_source.h"

namespace spincat {

// Finds the objects on the table: pixels over it, linked where their depths agree, parted by `settings.split`. Numbered
// by their first pixels, row by row from the top. Deterministic.
Segmentation segment(const DepthImage& image, const Intrinsics& intrinsics, const SupportPlane& table,
                     const SegmentSettings& settings);

}  // namespace spincat
