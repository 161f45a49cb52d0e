// Where the vertices of a glTF primitive are: its positions, moved by morph targets and by the joints of a skin.
// Private to io.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "spincat/geometry/object.h"
#include "spincat/io/formats/gltf_document.h"
#include "spincat/io/formats/gltf_values.h"

namespace spincat::io {

using GltfTransform = Eigen::Matrix4d;

// Of a node, relative to its parent.
GltfTransform gltf_local_transform(const tinygltf::Node& node);

GltfTransform gltf_transform(const Vec3& translation, const Eigen::Vector4d& rotation, const Vec3& scale);

// The joints of every skin that is asked for.
class GltfSkins {
 public:
  explicit GltfSkins(const tinygltf::Model& model) : model_(model) {}

  // Where each joint puts what is bound to it; the same memory each time.
  const std::vector<GltfTransform>& joints(int skin);

  // Bytes that the joints asked for so far take, and those of one skin more.
  std::uint64_t memory() const { return memory_; }
  std::uint64_t memory_with(int skin) const;

 private:
  void place_nodes();

  const tinygltf::Model& model_;
  std::vector<GltfTransform> nodes_;  // where they are in the world; none before the first skin
  std::map<int, std::vector<GltfTransform>> skins_;
  std::uint64_t memory_ = 0;
};

// How a primitive is shown.
struct GltfPose {
  GltfTransform node = GltfTransform::Identity();  // where its node is
  std::span<const double> weights = {};            // of its morph targets
  const std::vector<GltfTransform>* joints = nullptr;
};

class GltfVertices {
 public:
  // The primitive has positions.
  GltfVertices(const tinygltf::Model& model, const tinygltf::Primitive& primitive, const GltfPose& pose);

  std::size_t count() const { return positions_.count(); }

  // The accessors that decide: two primitives with the same ones and the same pose have the same vertices.
  const std::vector<int>& accessors() const { return accessors_; }

  // Throws InputError where one of them is not in order. Once, before position().
  void check() const;

  // Throws InputError where it is not finite.
  Vec3 position(std::size_t vertex) const;

  // Whether the transform turns faces inside out.
  bool mirrored() const;

 private:
  void read_targets(const tinygltf::Model& model, const tinygltf::Primitive& primitive, const GltfPose& pose);
  void read_joints(const tinygltf::Model& model, const tinygltf::Primitive& primitive);
  GltfValues further(const tinygltf::Model& model, int accessor, int type);
  GltfTransform transform_of(std::size_t vertex) const;

  std::vector<int> accessors_;
  GltfValues positions_;
  std::vector<std::pair<double, GltfValues>> targets_;         // how far each moves them
  std::vector<std::pair<GltfValues, GltfValues>> influences_;  // numbers of four joints, and the weight of each
  GltfTransform node_;
  const std::vector<GltfTransform>* joints_;
};

}  // namespace spincat::io
