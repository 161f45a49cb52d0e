#include "spincat/io/write_object.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <variant>

#include "spincat/error.h"
#include "spincat/files/output_file.h"
#include "spincat/files/paths.h"

namespace spincat {
namespace {

constexpr std::size_t kPiece = 1 << 20;  // bytes that are written at once

// The bytes of numbers, the lowest one first, piece by piece into a file.
class ByteWriter {
 public:
  explicit ByteWriter(OutputFile& out) : out_(out) {}

  void text(std::string_view words) { put(words); }

  template <class T>
  void number(T value) {
    std::array<char, sizeof(T)> bytes;
    std::memcpy(bytes.data(), &value, sizeof(T));
    if constexpr (std::endian::native == std::endian::big) {
      std::ranges::reverse(bytes);
    }
    put({bytes.data(), bytes.size()});
  }

  void vector(const Vec3& v) {
    for (const double coordinate : v) {
      number(coordinate);
    }
  }

  void finish() {
    out_.write(piece_);
    piece_.clear();
  }

 private:
  void put(std::string_view bytes) {
    if (piece_.size() + bytes.size() > kPiece) {
      finish();
    }
    piece_ += bytes;
  }

  OutputFile& out_;
  std::string piece_;
};

void write_rows(const PointCloud& cloud, ByteWriter& out) {
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    out.vector(cloud.points[i]);
    if (!cloud.normals.empty()) {
      out.vector(cloud.normals[i]);
    }
  }
}

void write_ply(const Mesh& mesh, ByteWriter& out) {
  out.text(
      fmt::format("ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty double x\nproperty double y\n"
                  "property double z\nelement face {}\nproperty list uchar uint vertex_indices\nend_header\n",
                  mesh.vertices.size(), mesh.triangles.size()));
  for (const Vec3& vertex : mesh.vertices) {
    out.vector(vertex);
  }
  for (const Triangle& triangle : mesh.triangles) {
    out.number(std::uint8_t{3});
    for (const std::uint32_t corner : triangle) {
      out.number(corner);
    }
  }
}

void write_ply(const PointCloud& cloud, ByteWriter& out) {
  out.text(
      fmt::format("ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty double x\nproperty double y\n"
                  "property double z\n{}end_header\n",
                  cloud.points.size(),
                  cloud.normals.empty() ? "" : "property double nx\nproperty double ny\nproperty double nz\n"));
  write_rows(cloud, out);
}

void write_pcd(const PointCloud& cloud, ByteWriter& out) {
  const bool oriented = !cloud.normals.empty();
  // The same turn as 1 0 0 0, with which a sensor at the origin would be taken for an unknown one.
  const std::string viewpoint =
      cloud.sensor ? fmt::format("{} {} {} -1 0 0 0", cloud.sensor->x(), cloud.sensor->y(), cloud.sensor->z())
                   : "0 0 0 1 0 0 0";
  out.text(
      fmt::format("# .PCD v0.7\nVERSION 0.7\nFIELDS x y z{}\nSIZE 8 8 8{}\nTYPE F F F{}\nCOUNT 1 1 1{}\nWIDTH {}\n"
                  "HEIGHT 1\nVIEWPOINT {}\nPOINTS {}\nDATA binary\n",
                  oriented ? " normal_x normal_y normal_z" : "", oriented ? " 8 8 8" : "", oriented ? " F F F" : "",
                  oriented ? " 1 1 1" : "", cloud.points.size(), viewpoint, cloud.points.size()));
  write_rows(cloud, out);
}

}  // namespace

void write_object(const std::filesystem::path& file, const Object& object) {
  const std::string extension = lower_extension(file);
  const auto* cloud = std::get_if<PointCloud>(&object);
  if (extension != ".ply" && extension != ".pcd") {
    throw InputError(file.string(), "expected a name that ends in .ply or .pcd");
  }
  if (extension == ".pcd" && cloud == nullptr) {
    throw InputError(file.string(), "PCD files hold no faces; expected a name that ends in .ply");
  }
  OutputFile target(file);
  ByteWriter out(target);
  if (cloud == nullptr) {
    write_ply(std::get<Mesh>(object), out);
  } else if (extension == ".ply") {
    write_ply(*cloud, out);
  } else {
    write_pcd(*cloud, out);
  }
  out.finish();
  target.commit();
}

}  // namespace spincat
