// The ways to make one spin image; the tests of the definition run on every one of them.
#pragma once

#include <cstdlib>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "spin/points.h"
#include "spincat/spin/kernel.h"
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

// Forces one path of the fast engine while it lives.
class ForcedPath {
 public:
  explicit ForcedPath(const std::string& path) { setenv("SPINCAT_SIMD", path.c_str(), 1); }
  ~ForcedPath() { unsetenv("SPINCAT_SIMD"); }
  ForcedPath(const ForcedPath&) = delete;
  ForcedPath& operator=(const ForcedPath&) = delete;
};

inline std::vector<Engine> engines() {
  std::vector<Engine> all = {{"reference", reference_image}};
  for (const std::string& path : simd_paths()) {
    const auto image = [path](const OrientedPoints& surface, const OrientedPoint& spin, const SpinImageParams& params) {
      const ForcedPath forced(path);
      const SpinImages images = make_spin_images(surface, points_of({spin}), params);
      return std::vector<float>(images.values().begin(), images.values().end());
    };
    all.push_back({path, image});
  }
  return all;
}

}  // namespace spincat::test
