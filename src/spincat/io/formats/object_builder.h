// Collects what a reader finds and checks it on the way. Private to io.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "spincat/error.h"
#include "spincat/geometry/object.h"
#include "spincat/io/formats/vertex_merger.h"
#include "spincat/io/read_limits.h"

namespace spincat::io {

// "vertex index 9 is out of range (8 vertices)"; the caller adds the line.
inline std::string out_of_range(std::int64_t index, std::uint64_t vertices) {
  return fmt::format("vertex index {} is out of range ({} vertices)", index, vertices);
}

class ObjectBuilder {
 public:
  explicit ObjectBuilder(const ReadLimits& limits) : limits_(limits) {
    if (limits_.max_points > kMostVertices) {
      limits_.max_points = kMostVertices;
    }
  }

  // Throws when so many vertices are not allowed. Reserves no memory: that is for expect_vertices, once the caller
  // knows that the file is long enough for them.
  void check_vertices(std::uint64_t count) const {
    if (count > limits_.max_points) {
      throw InputError(fmt::format("holds more than {} points; --max-points raises this limit", limits_.max_points));
    }
  }
  void check_triangles(std::uint64_t count) const {
    if (count > limits_.max_triangles) {
      throw InputError(
          fmt::format("holds more than {} triangles; --max-triangles raises this limit", limits_.max_triangles));
    }
  }
  void expect_vertices(std::uint64_t count) {
    check_vertices(count);
    mesh_.vertices.reserve(count);
  }
  // As good a guess as the caller has; it too knows that the file is long enough.
  void reserve_triangles(std::uint64_t count) {
    mesh_.triangles.reserve(std::min<std::uint64_t>(count, limits_.max_triangles));
  }

  void add_vertex(const Vec3& vertex) {
    if (mesh_.vertices.size() == limits_.max_points) {
      check_vertices(limits_.max_points + std::uint64_t{1});
    }
    mesh_.vertices.push_back(vertex);
  }
  // The same for one that may not be finite: that is an error of a mesh where a face uses it, found at `line` (0:
  // none), and else it is left out, as in a cloud, where it means "nothing measured here".
  void add_vertex(const Vec3& vertex, std::size_t line) {
    if (!vertex.allFinite()) {
      unfinite_.push_back({static_cast<std::uint32_t>(mesh_.vertices.size()), line});
    }
    add_vertex(vertex);
  }
  // Adds a vertex unless there is an equal one; its index.
  std::uint32_t add_merged_vertex(const Vec3& vertex, VertexMerger& merger) {
    const std::uint32_t index = merger.index_of(vertex, mesh_.vertices);
    check_vertices(mesh_.vertices.size());
    return index;
  }
  // Normals of points; they are dropped when a face turns up or when not every point has one.
  void add_normal(const Vec3& normal) {
    if (mesh_.triangles.empty()) {
      normals_.push_back(normal);
    }
  }
  void forget_normals() { std::vector<Vec3>().swap(normals_); }
  void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    if (mesh_.triangles.size() == limits_.max_triangles) {
      check_triangles(limits_.max_triangles + std::uint64_t{1});
    }
    if (mesh_.triangles.empty()) {
      forget_normals();
    }
    mesh_.triangles.push_back({a, b, c});
    largest_index_ = std::max({largest_index_, a, b, c});
  }

  // In a point cloud a coordinate that is not finite means "nothing measured here".
  void add_point(const Vec3& point) {
    if (point.allFinite()) {
      add_vertex(point);
    } else {
      const std::size_t row = mesh_.vertices.size() + left_out_.size();
      if (row == kMostVertices) {
        check_vertices(row + std::uint64_t{1});
      }
      left_out_.push_back(static_cast<std::uint32_t>(row));
    }
  }
  void add_point(const Vec3& point, const Vec3& normal) {
    if (point.allFinite()) {
      add_normal(normal);
    }
    add_point(point);
  }

  // A polygon, corner by corner, becomes a fan around its first corner. One or two corners become nothing.
  void begin_face() { corners_ = 0; }
  void add_corner(std::uint32_t vertex) {
    if (corners_ == 0) {
      first_ = vertex;
    }
    if (corners_ >= 2) {
      add_triangle(first_, previous_, vertex);
    }
    previous_ = vertex;
    ++corners_;
  }

  // A strip of triangles, corner by corner: each corner makes a triangle with the two before it, turned the other way
  // round every second time. Those that use a vertex twice only turn the strip and become nothing.
  void begin_strip() { corners_ = 0; }
  void add_strip_corner(std::uint32_t vertex) {
    if (corners_ >= 2 && first_ != previous_ && previous_ != vertex && first_ != vertex) {
      corners_ % 2 == 0 ? add_triangle(first_, previous_, vertex) : add_triangle(previous_, first_, vertex);
    }
    first_ = previous_;
    previous_ = vertex;
    ++corners_;
  }

  void set_sensor(const Vec3& position) { sensor_ = position; }

  std::size_t vertices() const { return mesh_.vertices.size(); }
  std::size_t triangles() const { return mesh_.triangles.size(); }

  // Throws when so many more vertices and triangles, besides `memory` bytes that are taken already, are too much for a
  // file of so many bytes (check_growth).
  void check_more(std::uint64_t vertices, std::uint64_t triangles, std::uint64_t memory,
                  std::uint64_t file_size) const {
    // A vector that grows holds its old and its new memory for a moment.
    constexpr std::uint64_t kWhileGrowing = 3;
    check_growth(memory + kWhileGrowing * ((mesh_.vertices.size() + vertices) * sizeof(Vec3) +
                                           (mesh_.triangles.size() + triangles) * sizeof(Triangle)),
                 file_size, limits_);
  }

  // The object, a mesh where there is a face. Throws when there is nothing in it, or a corner that is no vertex:
  // readers check that with a line, but what they check against may be what a file announces.
  Object finish() {
    if (!mesh_.triangles.empty()) {
      if (largest_index_ >= mesh_.vertices.size()) {
        throw InputError(out_of_range(largest_index_, mesh_.vertices.size()));
      }
      drop_unfinite_vertices();
      mesh_.left_out = std::move(left_out_);
      return std::move(mesh_);
    }
    drop_unfinite_points();
    if (mesh_.vertices.empty()) {
      throw InputError(left_out_.empty() ? "holds neither a face nor a point"
                                         : "holds only points without finite coordinates");
    }
    if (normals_.size() != mesh_.vertices.size()) {
      forget_normals();
    }
    return PointCloud{std::move(mesh_.vertices), std::move(normals_), sensor_, std::move(left_out_)};
  }

 private:
  struct Unfinite {
    std::uint32_t vertex;
    std::size_t line;
  };

  // Throws when a face uses one.
  void drop_unfinite_vertices() {
    if (unfinite_.empty()) {
      return;
    }
    std::vector<std::uint32_t> dropped(mesh_.vertices.size());  // among the vertices before
    std::size_t next = 0;
    for (std::uint32_t i = 0; i < dropped.size(); ++i) {
      dropped[i] = static_cast<std::uint32_t>(next);
      next += is_unfinite(next, i) ? 1 : 0;
    }
    for (Triangle& triangle : mesh_.triangles) {
      for (std::uint32_t& corner : triangle) {
        if (is_unfinite(dropped[corner], corner)) {
          fail_as_unfinite(unfinite_[dropped[corner]]);
        }
        corner -= dropped[corner];
      }
    }
    leave_out_unfinite();
  }

  void leave_out_unfinite() {
    for (const Unfinite& one : unfinite_) {
      left_out_.push_back(one.vertex);
    }
    std::erase_if(mesh_.vertices, [](const Vec3& vertex) { return !vertex.allFinite(); });
  }

  bool is_unfinite(std::size_t place, std::uint32_t vertex) const {
    return place < unfinite_.size() && unfinite_[place].vertex == vertex;
  }

  [[noreturn]] static void fail_as_unfinite(const Unfinite& at) {
    throw InputError(fmt::format("{} {}: a coordinate is not finite", at.line == 0 ? "vertex" : "line",
                                 at.line == 0 ? at.vertex : at.line));
  }

  void drop_unfinite_points() {
    if (unfinite_.empty()) {
      return;
    }
    if (normals_.size() == mesh_.vertices.size()) {
      std::size_t next = 0;
      std::size_t kept = 0;
      for (std::uint32_t i = 0; i < normals_.size(); ++i) {
        if (is_unfinite(next, i)) {
          ++next;
        } else {
          normals_[kept++] = normals_[i];
        }
      }
      normals_.resize(kept);
    }
    leave_out_unfinite();
  }

  static constexpr std::size_t kMostVertices = std::numeric_limits<std::uint32_t>::max();

  ReadLimits limits_;
  Mesh mesh_;
  std::vector<Vec3> normals_;
  std::vector<Unfinite> unfinite_;  // in the order of their vertices
  std::optional<Vec3> sensor_;
  std::vector<std::uint32_t> left_out_;  // by one of the two add_point()s or by finish(): no reader uses both
  std::size_t corners_ = 0;
  std::uint32_t first_ = 0;
  std::uint32_t previous_ = 0;
  std::uint32_t largest_index_ = 0;  // of all triangles
};

}  // namespace spincat::io
