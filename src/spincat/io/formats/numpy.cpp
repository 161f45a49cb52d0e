// Clouds that NumPy has saved: an array with a point a row (.npy), or an archive of arrays of which one is that (.npz).
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "spincat/error.h"
#include "spincat/geometry/object.h"
#include "spincat/io/formats/format.h"
#include "spincat/io/formats/npy_array.h"
#include "spincat/io/formats/object_builder.h"
#include "spincat/io/formats/unit_normals.h"
#include "spincat/io/formats/zip.h"
#include "spincat/io/read_limits.h"
#include "spincat/io/text_cursor.h"

namespace spincat::io {
namespace {

constexpr std::uint64_t kMostColumns = 16;  // more are features of another kind, or a picture

// None where it may be a cloud.
std::optional<std::string> why_no_cloud(const NpyArray& array) {
  const std::vector<std::uint64_t>& shape = array.shape();
  if (shape.size() >= 2 && shape.back() >= 3 && shape.back() <= kMostColumns &&
      !(shape.size() > 2 && array.is_bytes())) {
    return std::nullopt;
  }
  const bool is_turned = shape.size() == 2 && (shape[0] == 3 || shape[0] == 6);
  return fmt::format("holds an array of {}, which is no cloud; expected N x 3, or N x 6 with normals{}",
                     array.shape_text(), is_turned ? " (numpy.transpose turns it)" : "");
}

// Normals from an array of their own, or from the last three of six columns.
Object make_cloud(const NpyArray& points, const NpyArray* normals, const ReadLimits& limits, std::uint64_t memory,
                  std::uint64_t file_size) {
  ObjectBuilder object(limits);
  object.check_vertices(points.rows());
  const bool own_normals = normals == nullptr && points.columns() == 6;
  check_growth(memory + points.rows() * sizeof(Vec3) * (own_normals || normals != nullptr ? 4 : 1), file_size, limits);
  object.expect_vertices(points.rows());
  UnitNormals looks;
  for (std::uint64_t i = 0; i < points.rows(); ++i) {
    const Vec3 point(points.at(i, 0), points.at(i, 1), points.at(i, 2));
    const NpyArray* source = own_normals ? &points : normals;
    const std::uint64_t from = own_normals ? 3 : 0;
    if (source == nullptr || !looks.possible()) {
      object.add_point(point);
      continue;
    }
    const Vec3 normal(source->at(i, from), source->at(i, from + 1), source->at(i, from + 2));
    object.add_point(point, normal);
    looks.look_at(normal);
  }
  if (!looks.found()) {
    object.forget_normals();
  }
  return object.finish();
}

Object read_array(const FileContent& file, const ReadLimits& limits) {
  const NpyArray array(file.bytes);
  if (const auto problem = why_no_cloud(array)) {
    throw InputError(*problem);
  }
  return make_cloud(array, nullptr, limits, 0, file.bytes.size());
}

class ArchiveReader {
 public:
  ArchiveReader(const FileContent& file, const ReadLimits& limits) : file_(file), limits_(limits), zip_(file.bytes) {}

  Object read() {
    const ZipEntry& entry = choose();
    const std::string bytes = unpack(entry);
    const NpyArray points(bytes);
    const ZipEntry* other = zip_.find("normals.npy");
    if (other == nullptr || other == &entry || points.columns() != 3) {
      return make_cloud(points, nullptr, limits_, memory_, file_.bytes.size());
    }
    const std::string more = unpack(*other);
    const NpyArray normals(more);
    const bool fits = normals.columns() == 3 && normals.rows() == points.rows();
    return make_cloud(points, fits ? &normals : nullptr, limits_, memory_, file_.bytes.size());
  }

 private:
  static std::string_view name_of(const ZipEntry& entry) {
    std::string_view name = entry.name;
    name.remove_suffix(name.ends_with(".npy") ? 4 : 0);
    return name;
  }

  std::string unpack(const ZipEntry& entry) {
    constexpr std::uint64_t kWhileGrowing = 3;
    memory_ += entry.size;
    check_growth(memory_ + (kWhileGrowing - 1) * entry.size, file_.bytes.size(), limits_);
    return zip_.unpack(entry);
  }

  // Whether an entry can be a cloud, by the first bytes of it.
  bool fits(const ZipEntry& entry) const {
    constexpr std::size_t kEnough = 1 << 12;  // for the header of any array of numbers
    std::string begin;
    zip_.unpack(entry, [&](std::string_view piece) {
      begin += piece.substr(0, kEnough - begin.size());
      return begin.size() < kEnough;
    });
    return NpyArray::is_begin(begin) && !why_no_cloud(NpyArray(begin, entry.size));
  }

  // The only one that can be a cloud, or else the one with a name that says so.
  const ZipEntry& choose() const {
    static constexpr std::array<std::string_view, 10> kNames = {"points", "xyz",   "pos",      "positions",  "vertices",
                                                                "coords", "coord", "points3d", "pointcloud", "pc"};
    constexpr std::size_t kMostArrays = 1'000;  // the first bytes of each are unpacked
    if (zip_.entries().size() > kMostArrays) {
      throw InputError(fmt::format("holds more than {} arrays", kMostArrays));
    }
    std::vector<const ZipEntry*> fitting;
    for (const ZipEntry& entry : zip_.entries()) {
      if (entry.name.ends_with(".npy") && name_of(entry) != "normals" && fits(entry)) {
        fitting.push_back(&entry);
      }
    }
    for (const std::string_view name : kNames) {
      for (const ZipEntry* entry : fitting) {
        if (name_of(*entry) == name) {
          return *entry;
        }
      }
    }
    if (fitting.size() == 1) {
      return *fitting.front();
    }
    if (fitting.empty()) {
      throw InputError("holds no array that is a cloud; expected N x 3, or N x 6 with normals");
    }
    std::vector<std::string> names;
    for (const ZipEntry* entry : fitting) {
      names.push_back(in_quotes(name_of(*entry)));
    }
    names.resize(std::min<std::size_t>(names.size(), 5));
    throw InputError(fmt::format("holds {} arrays that may be the cloud: {}; call one of them 'points'", fitting.size(),
                                 fmt::join(names, ", ")));
  }

  const FileContent& file_;
  const ReadLimits& limits_;
  ZipArchive zip_;
  std::uint64_t memory_ = 0;
};

Object read_numpy(const FileContent& file, const ReadLimits& limits) {
  return file.bytes.starts_with("PK") ? ArchiveReader(file, limits).read() : read_array(file, limits);
}

}  // namespace

ObjectFormat numpy_format() {
  return {.extensions = {".npy", ".npz"}, .read = read_numpy};
}

}  // namespace spincat::io
