// Scans of KITTI and its kin: rows of four floats, x y z and an intensity, and nothing else.
#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "spincat/error.h"
#include "spincat/geometry/object.h"
#include "spincat/io/formats/binary.h"
#include "spincat/io/formats/format.h"
#include "spincat/io/formats/object_builder.h"
#include "spincat/io/read_limits.h"

namespace spincat::io {
namespace {

constexpr std::size_t kRow = 16;

// Other files are called .bin, too; as floats their bytes are all sizes.
void check_plausible(const Vec3& point, std::uint64_t row) {
  constexpr double kFarthest = 1e6;  // metres
  if (point.allFinite() && point.cwiseAbs().maxCoeff() > kFarthest) {
    throw InputError(
        fmt::format("is no scan of KITTI's kind (rows of four floats: x y z intensity): point {} is at {} {} {}", row,
                    point.x(), point.y(), point.z()));
  }
}

Object read_kitti(const FileContent& file, const ReadLimits& limits) {
  if (file.bytes.size() % kRow != 0) {
    throw InputError(
        fmt::format("is no scan of KITTI's kind (rows of four floats: x y z intensity): its {} bytes are "
                    "no multiple of {}",
                    file.bytes.size(), kRow));
  }
  ObjectBuilder object(limits);
  object.expect_vertices(file.bytes.size() / kRow);
  for (std::uint64_t i = 0; i < file.bytes.size() / kRow; ++i) {
    const char* at = file.bytes.data() + i * kRow;
    const Vec3 point(load<float>(at), load<float>(at + 4), load<float>(at + 8));
    check_plausible(point, i);
    object.add_point(point);
  }
  return object.finish();
}

}  // namespace

ObjectFormat kitti_format() {
  return {.extensions = {}, .ambiguous_extensions = {".bin"}, .read = read_kitti};
}

}  // namespace spincat::io
