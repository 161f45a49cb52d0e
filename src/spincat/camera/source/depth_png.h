// Depth pictures as 16-bit PNG files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "spincat/camera/source/frame_source.h"
#include "spincat/io/read_limits.h"

namespace spincat {

// What the first bytes of a file say.
enum class PictureKind {
  depths,    // a grey PNG file of 16 bits
  few_bits,  // a grey one of fewer
  colours,   // one in colours
  unknown    // no PNG file
};

// `bytes`: the first kKindBytes of a file.
inline constexpr std::size_t kKindBytes = 26;
PictureKind kind_of_picture(std::string_view bytes);

// Reads the bytes of a grey PNG file of 16 (or 8) bits: depths in 1 / units_per_metre, 0 for no reading. Throws
// InputError (without a file name) when it is no such file, damaged, larger than 8,192 x 8,192, or would take more
// memory than limits.max_growth lets a file of its size take.
DepthImage decode_depth_png(std::string_view bytes, double units_per_metre, const ReadLimits& limits = {});

// The other way round: depths are rounded, those beyond 65,535 units become 0.
std::string encode_depth_png(const DepthImage& image, double units_per_metre);

// A 16-bit grey PNG file of width x height numbers, row by row from the top.
std::string encode_png16(const std::vector<std::uint16_t>& values, int width, int height);

}  // namespace spincat
