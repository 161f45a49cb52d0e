// A data set of a few shapes that takes milliseconds to learn.
#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <string>

#include "spincat/dataset/dataset.h"
#include "spincat/settings/settings.h"
#include "support/shapes.h"
#include "support/temp_dir.h"

namespace spincat::test {

inline Settings tiny_settings() {
  Settings settings = preset("default");
  settings.prepare.points = 200;
  settings.prepare.spin_points = 32;
  settings.spin.image_width = 8;
  settings.spin.bin_size = 0.25;
  settings.plain_samples = false;
  settings.radial = false;
  settings.copies = 1;
  settings.background = 12;
  return settings;
}

// Number `k` of a kind: "box", "cone" or "spindle".
inline Mesh tiny_shape(const std::string& kind, int k) {
  const double wide = 0.8 + 0.1 * k;
  return kind == "box" ? box(1, wide, 1.1) : cylinder(16, kind == "cone" ? wide : 0.1 * wide, 0.0, 1.2 + 0.1 * k);
}

// DIR/kind/0.off, ... with `count` objects each.
inline void write_tiny_shapes(const TempDir& dir, const std::string& folder, int count, int first = 0) {
  for (const char* kind : {"box", "cone", "spindle"}) {
    for (int k = first; k < first + count; ++k) {
      dir.write(fmt::format("{}/{}/{}.off", folder, kind, k), off_text(tiny_shape(kind, k)));
    }
  }
}

}  // namespace spincat::test
