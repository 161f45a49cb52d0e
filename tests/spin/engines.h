// The ways to make one spin image; the tests of the definition run on every one of them.
#pragma once

#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "spin/points.h"
#include "spincat/spin/reference.h"
#include "spincat/spin/spin_images.h"

namespace spincat::test {

struct Engine {
  std::string name;
  std::function<std::vector<float>(const OrientedPoints& surface, const OrientedPoint& spin, const SpinImageParams&)>
      image;
};

inline void PrintTo(const Engine& engine, std::ostream* out) {
  *out << engine.name;
}

inline std::vector<float> reference_image(const OrientedPoints& surface, const OrientedPoint& spin,
                                          const SpinImageParams& params) {
  std::vector<float> image(params.shape().size());
  spin_image_reference(surface, points_of({spin}), 0, params, image);
  return image;
}

inline std::vector<Engine> engines() {
  return {{"reference", reference_image}};
}

}  // namespace spincat::test
