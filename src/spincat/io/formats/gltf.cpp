// glTF 2.0: walks the scene and gathers its triangles, each where its node places it.
#include <fmt/format.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "spincat/error.h"
#include "spincat/geometry/object.h"
#include "spincat/io/formats/binary.h"
#include "spincat/io/formats/format.h"
#include "spincat/io/formats/gltf_document.h"
#include "spincat/io/formats/object_builder.h"
#include "spincat/io/read_limits.h"

namespace spincat::io {
namespace {

using Transform = Eigen::Matrix4d;

// The element that an index of the file names; "its node 3 does not exist" where it names none.
template <typename T>
const T& element_at(const std::vector<T>& list, int index, const char* what) {
  if (index < 0 || static_cast<std::size_t>(index) >= list.size()) {
    throw InputError(fmt::format("its {} {} does not exist ({} do)", what, index, list.size()));
  }
  return list[static_cast<std::size_t>(index)];
}

// An accessor whose every value is known to lie in its buffer.
class Values {
 public:
  Values(const tinygltf::Model& model, int index, int type) : index_(index) {
    const tinygltf::Accessor& accessor = element_at(model.accessors, index, "accessor");
    if (accessor.sparse.isSparse) {
      fail("is sparse, which spincat does not read");
    }
    if (accessor.bufferView < 0) {
      fail("has no data in the file (it may be compressed)");
    }
    if (accessor.type != type) {
      fail("holds values of the wrong kind");
    }
    const tinygltf::BufferView& view = element_at(model.bufferViews, accessor.bufferView, "bufferView");
    const std::vector<unsigned char>& buffer = element_at(model.buffers, view.buffer, "buffer").data;
    if (view.byteOffset > buffer.size() || view.byteLength > buffer.size() - view.byteOffset) {
      throw InputError(fmt::format("its bufferView {} reaches beyond its buffer", accessor.bufferView));
    }

    type_ = component_type(accessor.componentType);
    normalized_ = accessor.normalized;
    const std::size_t element_size =
        size_of(type_) *
        static_cast<std::size_t>(tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type)));
    stride_ = view.byteStride == 0 ? element_size : view.byteStride;
    if (stride_ < element_size) {
      fail("has values that overlap");
    }
    count_ = accessor.count;
    if (count_ > 0 && (accessor.byteOffset > view.byteLength || element_size > view.byteLength - accessor.byteOffset ||
                       count_ - 1 > (view.byteLength - accessor.byteOffset - element_size) / stride_)) {
      fail("reaches beyond its bufferView");
    }
    data_ = reinterpret_cast<const char*>(buffer.data()) + view.byteOffset + (count_ > 0 ? accessor.byteOffset : 0);
  }

  std::size_t count() const { return count_; }

  double value(std::size_t element, std::size_t component) const {
    const double raw = load_scalar(data_ + element * stride_ + component * size_of(type_), type_);
    return normalized_ ? std::max(raw / largest(), -1.0) : raw;
  }

  std::uint32_t index(std::size_t element, std::size_t vertices) const {
    const double index = value(element, 0);
    if (!(index >= 0 && index < static_cast<double>(vertices))) {
      fail(fmt::format("holds the vertex index {}, which is out of range ({} vertices)", index, vertices));
    }
    return static_cast<std::uint32_t>(index);
  }

  [[noreturn]] void fail(const std::string& problem) const {
    throw InputError(fmt::format("its accessor {} {}", index_, problem));
  }

 private:
  ScalarType component_type(int type) const {
    switch (type) {
      case TINYGLTF_COMPONENT_TYPE_BYTE:
        return ScalarType::int8;
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return ScalarType::uint8;
      case TINYGLTF_COMPONENT_TYPE_SHORT:
        return ScalarType::int16;
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return ScalarType::uint16;
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return ScalarType::uint32;
      case TINYGLTF_COMPONENT_TYPE_FLOAT:
        return ScalarType::float32;
      default:
        fail(fmt::format("has the unknown componentType {}", type));
    }
  }

  // What a normalized integer divides by to become 1.
  double largest() const {
    switch (type_) {
      case ScalarType::int8:
        return 127;
      case ScalarType::uint8:
        return 255;
      case ScalarType::int16:
        return 32767;
      case ScalarType::uint16:
        return 65535;
      default:
        return 1;
    }
  }

  int index_;
  ScalarType type_ = ScalarType::float32;
  bool normalized_ = false;
  std::size_t stride_ = 0;
  std::size_t count_ = 0;
  const char* data_ = nullptr;
};

Transform local_transform(const tinygltf::Node& node) {
  if (node.matrix.size() == 16) {
    return Eigen::Map<const Transform>(node.matrix.data());  // both by columns
  }
  Eigen::Affine3d transform = Eigen::Affine3d::Identity();
  if (node.translation.size() == 3) {
    transform.translate(Eigen::Map<const Vec3>(node.translation.data()));
  }
  if (const auto& r = node.rotation; r.size() == 4) {
    transform.rotate(Eigen::Quaterniond(r[3], r[0], r[1], r[2]).normalized());
  }
  if (node.scale.size() == 3) {
    transform.scale(Eigen::Map<const Vec3>(node.scale.data()));
  }
  return transform.matrix();
}

class SceneReader {
 public:
  SceneReader(const GltfDocument& document, const ReadLimits& limits)
      : document_(document), model_(document.model), object_(limits), visited_(model_.nodes.size(), false) {}

  Object read() {
    if (model_.nodes.empty()) {
      for (const tinygltf::Mesh& mesh : model_.meshes) {
        add_mesh(mesh, Transform::Identity());
      }
    } else {
      for (const int root : roots()) {
        walk(root);
      }
    }
    return object_.finish();
  }

 private:
  // The nodes of the scene to show; in a file without scenes, those that are nobody's child.
  std::vector<int> roots() const {
    if (!model_.scenes.empty()) {
      return element_at(model_.scenes, std::max(model_.defaultScene, 0), "scene").nodes;
    }
    std::vector<bool> is_child(model_.nodes.size(), false);
    for (const tinygltf::Node& node : model_.nodes) {
      for (const int child : node.children) {
        if (child >= 0 && static_cast<std::size_t>(child) < is_child.size()) {
          is_child[static_cast<std::size_t>(child)] = true;
        }
      }
    }
    std::vector<int> list;
    for (std::size_t i = 0; i < is_child.size(); ++i) {
      if (!is_child[i]) {
        list.push_back(static_cast<int>(i));
      }
    }
    return list;
  }

  // Goes through a node and all below it, in the order of the file and without recursion: it may be very deep.
  void walk(int root) {
    std::vector<std::pair<int, Transform>> waiting{{root, Transform::Identity()}};
    while (!waiting.empty()) {
      const auto [index, parent] = waiting.back();
      waiting.pop_back();
      const tinygltf::Node& node = element_at(model_.nodes, index, "node");
      // glTF demands a tree. This is what ends a circle, and keeps diamonds from doubling at every level.
      if (visited_[static_cast<std::size_t>(index)]) {
        throw InputError(fmt::format("its node {} is below two nodes or below itself", index));
      }
      visited_[static_cast<std::size_t>(index)] = true;
      const Transform transform = parent * local_transform(node);
      // A mesh with a skin is placed by its bones, not by its node; at rest that leaves it as it is written.
      if (node.mesh >= 0) {
        add_mesh(element_at(model_.meshes, node.mesh, "mesh"),
                 node.skin >= 0 ? Transform(Transform::Identity()) : transform);
      }
      for (auto child = node.children.rbegin(); child != node.children.rend(); ++child) {
        waiting.emplace_back(*child, transform);
      }
    }
  }

  void add_mesh(const tinygltf::Mesh& mesh, const Transform& transform) {
    std::map<int, std::uint32_t> placed;  // the primitives of a mesh often share one list of vertices
    for (const tinygltf::Primitive& primitive : mesh.primitives) {
      ++primitives_;
      check_more(0, 0);
      const bool is_lines = primitive.mode == TINYGLTF_MODE_LINE || primitive.mode == TINYGLTF_MODE_LINE_LOOP ||
                            primitive.mode == TINYGLTF_MODE_LINE_STRIP;
      const auto position = primitive.attributes.find("POSITION");
      if (is_lines || position == primitive.attributes.end()) {
        continue;
      }
      const Values positions(model_, position->second, TINYGLTF_TYPE_VEC3);
      const auto [known, is_new] = placed.try_emplace(position->second, static_cast<std::uint32_t>(object_.vertices()));
      if (is_new) {
        add_vertices(positions, transform);
      }
      const bool mirrored = transform.topLeftCorner<3, 3>().determinant() < 0;
      add_faces(primitive, known->second, positions.count(), mirrored);
    }
  }

  void add_vertices(const Values& positions, const Transform& transform) {
    object_.check_vertices(object_.vertices() + positions.count());
    check_more(positions.count(), 0);  // nodes may repeat a mesh, and accessors each other's bytes
    for (std::size_t i = 0; i < positions.count(); ++i) {
      const Vec3 local(positions.value(i, 0), positions.value(i, 1), positions.value(i, 2));
      const Vec3 placed = (transform * local.homogeneous()).head<3>();
      if (!placed.allFinite()) {
        positions.fail(fmt::format("holds the vertex {}, which is not finite", i));
      }
      object_.add_vertex(placed);
    }
  }

  // A mirror turns faces inside out; glTF says to turn them back.
  void add_faces(const tinygltf::Primitive& primitive, std::uint32_t first, std::size_t vertices, bool mirrored) {
    const int mode = primitive.mode;
    if (mode == TINYGLTF_MODE_POINTS) {
      return;
    }
    if (mode != TINYGLTF_MODE_TRIANGLES && mode != TINYGLTF_MODE_TRIANGLE_STRIP && mode != TINYGLTF_MODE_TRIANGLE_FAN) {
      throw InputError(fmt::format("has a primitive of the unknown mode {}", mode));
    }
    std::vector<Values> indices;  // one or none
    if (primitive.indices >= 0) {
      indices.emplace_back(model_, primitive.indices, TINYGLTF_TYPE_SCALAR);
    }
    const std::size_t corners = indices.empty() ? vertices : indices[0].count();
    const auto corner = [&](std::size_t i) {
      return first + (indices.empty() ? static_cast<std::uint32_t>(i) : indices[0].index(i, vertices));
    };
    const std::size_t step = mode == TINYGLTF_MODE_TRIANGLES ? 3 : 1;
    check_more(0, corners / step);
    for (std::size_t i = 0; i + 2 < corners; i += step) {
      const std::uint32_t a = corner(mode == TINYGLTF_MODE_TRIANGLE_FAN ? 0 : i);
      std::uint32_t b = corner(i + 1), c = corner(i + 2);
      const bool odd_of_strip = mode == TINYGLTF_MODE_TRIANGLE_STRIP && i % 2 == 1;
      if (mirrored != odd_of_strip) {
        std::swap(b, c);
      }
      object_.add_triangle(a, b, c);
    }
  }

  // Primitives take time even where they add nothing, and half a file of nodes may show a mesh of the other half: each
  // time that one is looked at counts as if it took memory.
  void check_more(std::uint64_t vertices, std::uint64_t triangles) const {
    constexpr std::uint64_t kForEachPrimitive = 64;
    object_.check_more(vertices, triangles, document_.memory + kForEachPrimitive * primitives_, document_.file_size);
  }

  const GltfDocument& document_;
  const tinygltf::Model& model_;
  ObjectBuilder object_;
  std::vector<bool> visited_;
  std::uint64_t primitives_ = 0;  // looked at so far, those of a mesh each time that it is shown
};

Object read_gltf(const FileContent& file, const ReadLimits& limits) {
  const GltfDocument document = read_gltf_document(file.bytes, file.folder, limits);
  return SceneReader(document, limits).read();
}

}  // namespace

ObjectFormat gltf_format() {
  return {.extensions = {".gltf", ".glb"}, .read = read_gltf};
}

}  // namespace spincat::io
