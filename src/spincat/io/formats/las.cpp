// LAS 1.0 to 1.4 of the ASPRS: points of laser scanners, uncompressed.
#include <fmt/format.h>

#include <array>
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

// Where the header has what is read of it.
enum Offset : std::size_t {
  kMajor = 24,
  kMinor = 25,
  kPoints = 96,   // where they begin
  kFormat = 104,  // of a point
  kRecord = 105,  // bytes of a point
  kCountOf32Bits = 107,
  kScale = 131,
  kShift = 155,
  kEndOfFirstHeader = 227,
  kCountOf64Bits = 247,
  kEndOfLastHeader = 255,
};

struct Header {
  std::uint64_t begin = 0;
  std::uint64_t record = 0;
  std::uint64_t count = 0;
  Vec3 scale, shift;
};

// Bytes of a point, by its format; more may follow them.
constexpr std::array<std::uint64_t, 11> kSizes = {20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};

unsigned byte_at(std::string_view bytes, std::size_t at) {
  return static_cast<unsigned char>(bytes[at]);
}

void check_format(std::string_view bytes, std::uint64_t record) {
  constexpr unsigned kCompressed = 0xC0;  // as LASzip marks it
  const unsigned format = byte_at(bytes, kFormat);
  if ((format & kCompressed) != 0) {
    throw InputError(
        "is compressed (LAZ), which spincat does not read; convert it with PDAL: pdal translate a.laz a.las");
  }
  if (format >= kSizes.size()) {
    throw InputError(fmt::format("has points of the format {}; spincat reads 0 to {}", format, kSizes.size() - 1));
  }
  if (record < kSizes[format]) {
    throw InputError(
        fmt::format("has points of {} bytes; those of its format, {}, have {}", record, format, kSizes[format]));
  }
}

std::uint64_t count_of(std::string_view bytes) {
  const std::uint64_t count = load<std::uint32_t>(bytes.data() + kCountOf32Bits);
  const bool has_both = byte_at(bytes, kMinor) >= 4 && bytes.size() >= kEndOfLastHeader;
  return count == 0 && has_both ? load<std::uint64_t>(bytes.data() + kCountOf64Bits) : count;
}

Header read_header(std::string_view bytes) {
  if (!bytes.starts_with("LASF")) {
    throw InputError("is no LAS file: it does not begin with 'LASF'");
  }
  if (bytes.size() < kEndOfFirstHeader) {
    throw InputError("is cut off within its header");
  }
  if (byte_at(bytes, kMajor) != 1 || byte_at(bytes, kMinor) > 4) {
    throw InputError(fmt::format("is a LAS file of version {}.{}; spincat reads 1.0 to 1.4", byte_at(bytes, kMajor),
                                 byte_at(bytes, kMinor)));
  }
  Header header;
  header.begin = load<std::uint32_t>(bytes.data() + kPoints);
  header.record = load<std::uint16_t>(bytes.data() + kRecord);
  header.count = count_of(bytes);
  check_format(bytes, header.record);
  for (int i = 0; i < 3; ++i) {
    header.scale[i] = load<double>(bytes.data() + kScale + 8 * i);
    header.shift[i] = load<double>(bytes.data() + kShift + 8 * i);
  }
  if (!header.scale.allFinite() || !header.shift.allFinite()) {
    throw InputError("has a scale or an offset that is not finite");
  }
  return header;
}

Object read_las(const FileContent& file, const ReadLimits& limits) {
  const std::string_view bytes = file.bytes;
  const Header header = read_header(bytes);
  const std::uint64_t there = header.begin > bytes.size() ? 0 : (bytes.size() - header.begin) / header.record;
  if (there < header.count) {
    throw InputError(fmt::format("is cut off: {} of {} points", there, header.count));
  }
  ObjectBuilder object(limits);
  object.expect_vertices(header.count);
  for (std::uint64_t i = 0; i < header.count; ++i) {
    const char* at = bytes.data() + header.begin + i * header.record;
    const Vec3 steps(load<std::int32_t>(at), load<std::int32_t>(at + 4), load<std::int32_t>(at + 8));
    object.add_point(steps.cwiseProduct(header.scale) + header.shift);
  }
  return object.finish();
}

}  // namespace

ObjectFormat las_format() {
  return {.extensions = {".las"}, .read = read_las};
}

}  // namespace spincat::io
