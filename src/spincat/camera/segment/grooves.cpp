// Splitting what touches: two convex things that stand side by side or on each other meet in a groove, where the
// surface lies behind the chord from one to the other.
#include <algorithm>
#include <array>
#include <cmath>

#include "spincat/camera/segment/patches.h"

namespace spincat {
namespace {

constexpr float kHalfChord = 0.012F;  // metres
constexpr int kLeastHalfChord = 3;    // pixels
constexpr int kMostHalfChord = 14;
constexpr float kMostEndsApart = 0.045F;  // metres of depth between a pixel and either end of its chord
constexpr int kRegrown = 16;              // pixels that parts grow back over the grooves
constexpr std::size_t kLeastPart = 100;   // pixels; smaller parts are given to their neighbours

// How far behind the chord a groove lies at least, at depth z.
float groove_depth(float z) {
  return 0.0015F + 0.0015F * z * z;
}

class Grooves {
 public:
  Grooves(const DepthImage& image, const Intrinsics& intrinsics, const Labels& patches)
      : image_(image), intrinsics_(intrinsics), patches_(patches), smooth_(image.depth) {
    each_pixel([&](int u, int v) { smooth_[image_.index(u, v)] = gated_mean(u, v); });
  }

  // The patches without their grooves.
  Labels cut() const {
    Labels left = patches_;
    each_pixel([&](int u, int v) {
      if (is_groove(u, v)) {
        left[image_.index(u, v)] = 0;
      }
    });
    return left;
  }

 private:
  template <class Visit>
  void each_pixel(Visit visit) const {
    for (int v = 0; v < image_.height; ++v) {
      for (int u = 0; u < image_.width; ++u) {
        if (patches_[image_.index(u, v)] != 0) {
          visit(u, v);
        }
      }
    }
  }

  // The mean depth of the pixels of the same patch around a pixel (5 x 5) whose depths agree with its own.
  float gated_mean(int u, int v) const {
    const std::size_t centre = image_.index(u, v);
    const float z = image_.depth[centre];
    const float gate = link_tolerance(z);
    float sum = 0.0F;
    int count = 0;
    for (int y = std::max(v - 2, 0); y <= std::min(v + 2, image_.height - 1); ++y) {
      for (int x = std::max(u - 2, 0); x <= std::min(u + 2, image_.width - 1); ++x) {
        const std::size_t i = image_.index(x, y);
        const bool counts = patches_[i] == patches_[centre] && std::abs(image_.depth[i] - z) < gate;
        sum += counts ? image_.depth[i] : 0.0F;
        count += counts ? 1 : 0;
      }
    }
    return sum / static_cast<float>(count);
  }

  bool is_groove(int u, int v) const {
    const float z = smooth_[image_.index(u, v)];
    const int half =
        std::clamp(static_cast<int>(std::lround(kHalfChord * intrinsics_.fx / z)), kLeastHalfChord, kMostHalfChord);
    const int diagonal = static_cast<int>(std::lround(half * 0.7071));
    return lies_behind_chord(u, v, half, 0) || lies_behind_chord(u, v, 0, half) ||
           lies_behind_chord(u, v, diagonal, diagonal) || lies_behind_chord(u, v, diagonal, -diagonal);
  }

  bool lies_behind_chord(int u, int v, int du, int dv) const {
    if (u - du < 0 || u + du >= image_.width || std::min(v - dv, v + dv) < 0 ||
        std::max(v - dv, v + dv) >= image_.height) {
      return false;
    }
    const std::size_t centre = image_.index(u, v);
    const std::size_t a = image_.index(u - du, v - dv);
    const std::size_t b = image_.index(u + du, v + dv);
    if (patches_[a] != patches_[centre] || patches_[b] != patches_[centre]) {
      return false;
    }
    const float z = smooth_[centre];
    return std::abs(smooth_[a] - z) < kMostEndsApart && std::abs(smooth_[b] - z) < kMostEndsApart &&
           z - 0.5F * (smooth_[a] + smooth_[b]) > groove_depth(z);
  }

  const DepthImage& image_;
  const Intrinsics& intrinsics_;
  const Labels& patches_;
  std::vector<float> smooth_;
};

// Sets the labels of patches of less than kLeastPart pixels to 0.
void drop_small(Labels& parts) {
  std::vector<std::size_t> pixels;
  for (const std::uint32_t part : parts) {
    if (part >= pixels.size()) {
      pixels.resize(part + 1, 0);
    }
    ++pixels[part];
  }
  for (std::uint32_t& part : parts) {
    part = part != 0 && pixels[part] < kLeastPart ? 0 : part;
  }
}

// Lets parts grow over pixels of their patch that belong to none, all at the same pace.
void grow(const DepthImage& image, const Labels& patches, Labels& parts) {
  struct Pixel {
    int u;
    int v;
  };
  constexpr std::array<Pixel, 4> kNext = {{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
  std::vector<Pixel> front;
  std::vector<Pixel> next_front;
  const auto spread_from = [&](const Pixel& from) {
    const std::size_t i = image.index(from.u, from.v);
    for (const Pixel& step : kNext) {
      const Pixel to{from.u + step.u, from.v + step.v};
      if (to.u < 0 || to.v < 0 || to.u >= image.width || to.v >= image.height) {
        continue;
      }
      const std::size_t j = image.index(to.u, to.v);
      if (patches[j] == patches[i] && parts[j] == 0 &&
          std::abs(image.depth[i] - image.depth[j]) < link_tolerance(image.depth[i])) {
        parts[j] = parts[i];
        next_front.push_back(to);
      }
    }
  };
  for (int v = 0; v < image.height; ++v) {
    for (int u = 0; u < image.width; ++u) {
      if (parts[image.index(u, v)] != 0) {
        front.push_back({u, v});
      }
    }
  }
  for (int pace = 0; pace < kRegrown && !front.empty(); ++pace) {
    next_front.clear();
    std::ranges::for_each(front, spread_from);
    front.swap(next_front);
  }
}

}  // namespace

Labels split_at_grooves(const DepthImage& image, const Intrinsics& intrinsics, const Labels& patches) {
  Labels parts = linked_patches(image, Grooves(image, intrinsics, patches).cut(), 1);
  drop_small(parts);
  grow(image, patches, parts);
  return parts;
}

}  // namespace spincat
