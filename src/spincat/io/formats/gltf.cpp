// glTF 2.0: walks the scene and gathers its triangles, each where its node places it.
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "spincat/error.h"
#include "spincat/geometry/object.h"
#include "spincat/io/formats/binary.h"
#include "spincat/io/formats/format.h"
#include "spincat/io/formats/gltf_document.h"
#include "spincat/io/formats/gltf_instances.h"
#include "spincat/io/formats/gltf_values.h"
#include "spincat/io/formats/gltf_vertices.h"
#include "spincat/io/formats/object_builder.h"
#include "spincat/io/read_limits.h"

namespace spincat::io {
namespace {

class SceneReader {
 public:
  SceneReader(const GltfDocument& document, const ReadLimits& limits)
      : document_(document),
        model_(document.model),
        object_(limits),
        skins_(model_),
        visited_(model_.nodes.size(), false) {}

  Object read() {
    if (model_.nodes.empty()) {
      for (const tinygltf::Mesh& mesh : model_.meshes) {
        add_mesh(mesh, {.weights = mesh.weights}, -1);
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
    std::vector<std::pair<int, GltfTransform>> waiting{{root, GltfTransform::Identity()}};
    while (!waiting.empty()) {
      const auto [index, parent] = waiting.back();
      waiting.pop_back();
      const tinygltf::Node& node = element_at(model_.nodes, index, "node");
      // glTF demands a tree. This is what ends a circle, and keeps diamonds from doubling at every level.
      if (visited_[static_cast<std::size_t>(index)]) {
        throw InputError(fmt::format("its node {} is below two nodes or below itself", index));
      }
      visited_[static_cast<std::size_t>(index)] = true;
      if (document_.hidden.contains(static_cast<std::size_t>(index))) {
        continue;
      }
      const GltfTransform transform = parent * gltf_local_transform(node);
      if (node.mesh >= 0) {
        add_instances(static_cast<std::size_t>(index), transform);
      }
      for (auto child = node.children.rbegin(); child != node.children.rend(); ++child) {
        waiting.emplace_back(*child, transform);
      }
    }
  }

  // The mesh of a node, as often as EXT_mesh_gpu_instancing says.
  void add_instances(std::size_t index, const GltfTransform& transform) {
    const tinygltf::Node& node = model_.nodes[index];
    const tinygltf::Mesh& mesh = element_at(model_.meshes, node.mesh, "mesh");
    GltfPose pose{transform, node.weights.empty() ? mesh.weights : node.weights, nullptr};
    const auto found = document_.instances.find(index);
    if (found == document_.instances.end()) {
      add_mesh(mesh, pose, node.skin);
      return;
    }
    const GltfInstances instances(model_, found->second);
    for (std::size_t i = 0; i < instances.count(); ++i) {
      ++primitives_;
      check_more(0, 0);
      pose.node = transform * instances.transform(i);
      add_mesh(mesh, pose, node.skin);
    }
  }

  // A mesh with a skin is placed by its joints, not by its node; without joints it is as it is written.
  void add_mesh(const tinygltf::Mesh& mesh, GltfPose pose, int skin) {
    if (skin >= 0) {
      pose.node = GltfTransform::Identity();
    }
    std::map<std::vector<int>, std::uint32_t> placed;  // the primitives of a mesh often share one list of vertices
    for (const tinygltf::Primitive& primitive : mesh.primitives) {
      ++primitives_;
      check_more(0, 0);
      const bool is_lines = primitive.mode == TINYGLTF_MODE_LINE || primitive.mode == TINYGLTF_MODE_LINE_LOOP ||
                            primitive.mode == TINYGLTF_MODE_LINE_STRIP;
      if (is_lines || !primitive.attributes.contains("POSITION")) {
        continue;
      }
      pose.joints = skin >= 0 && primitive.attributes.contains("JOINTS_0") ? joints_of(skin) : nullptr;
      const GltfVertices vertices(model_, primitive, pose);
      const auto [known, is_new] =
          placed.try_emplace(vertices.accessors(), static_cast<std::uint32_t>(object_.vertices()));
      if (is_new) {
        add_vertices(vertices);
      }
      add_faces(primitive, known->second, vertices.count(), vertices.mirrored());
    }
  }

  const std::vector<GltfTransform>* joints_of(int skin) {
    object_.check_more(0, 0, document_.memory + skins_.memory_with(skin), document_.file_size);
    return &skins_.joints(skin);
  }

  void add_vertices(const GltfVertices& vertices) {
    constexpr std::uint64_t kForEachValue = 12;  // of targets and joints, that take time and no memory
    object_.check_vertices(object_.vertices() + vertices.count());
    moved_ += kForEachValue * vertices.count() * (vertices.accessors().size() - 1);
    check_more(vertices.count(), 0);  // nodes may repeat a mesh, and accessors each other's bytes
    vertices.check();
    for (std::size_t i = 0; i < vertices.count(); ++i) {
      object_.add_vertex(vertices.position(i));
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
    std::optional<GltfValues> indices;
    if (primitive.indices >= 0) {
      indices.emplace(model_, primitive.indices, TINYGLTF_TYPE_SCALAR);
    }
    const std::size_t corners = indices ? indices->count() : vertices;
    const auto corner = [&](std::size_t i) {
      return first + (indices ? indices->index(i, vertices) : static_cast<std::uint32_t>(i));
    };
    const std::size_t step = mode == TINYGLTF_MODE_TRIANGLES ? 3 : 1;
    check_more(0, corners / step);
    if (indices) {
      indices->check_order();
    }
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
    object_.check_more(vertices, triangles,
                       document_.memory + skins_.memory() + moved_ + kForEachPrimitive * primitives_,
                       document_.file_size);
  }

  const GltfDocument& document_;
  const tinygltf::Model& model_;
  ObjectBuilder object_;
  GltfSkins skins_;
  std::vector<bool> visited_;
  std::uint64_t moved_ = 0;       // bytes that count for vertices that targets and joints move
  std::uint64_t primitives_ = 0;  // looked at so far, those of a mesh each time that it is shown
};

Object read_gltf(const FileContent& file, const ReadLimits& limits) {
  const GltfDocument document = read_gltf_document(file.bytes, file.folder, limits);
  return SceneReader(document, limits).read();
}

}  // namespace

ObjectFormat gltf_format() {
  return {.extensions = {".gltf", ".glb"}, .read = read_gltf, .likeness = likeness_of_gltf};
}

}  // namespace spincat::io
