// The slow, plain definition of a spin image: what every faster way must reproduce.
#pragma once

#include <cstddef>
#include <span>

#include "spincat/geometry/oriented_points.h"
#include "spincat/spin/params.h"

namespace spincat {

// Writes the image of the oriented point `k` of `spin_points` over all of `surface` to `image` (params.shape().size()
// floats; what was there before is overwritten). One point after the other, sums in double. Places and weights are
// computed in single precision, in the order that docs/how-it-works/spin-images.md gives, so that a point on the border
// of the support falls on the same side in every engine. Precondition: params are valid.
void spin_image_reference(const OrientedPoints& surface, const OrientedPoints& spin_points, std::size_t k,
                          const SpinImageParams& params, std::span<float> image);

}  // namespace spincat
