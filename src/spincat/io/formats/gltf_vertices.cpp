#include "spincat/io/formats/gltf_vertices.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <string>

#include "spincat/error.h"

namespace spincat::io {

GltfTransform gltf_transform(const Vec3& translation, const Eigen::Vector4d& rotation, const Vec3& scale) {
  Eigen::Affine3d transform = Eigen::Affine3d::Identity();
  transform.translate(translation);
  transform.rotate(Eigen::Quaterniond(rotation[3], rotation[0], rotation[1], rotation[2]).normalized());
  transform.scale(scale);
  return transform.matrix();
}

GltfTransform gltf_local_transform(const tinygltf::Node& node) {
  if (node.matrix.size() == 16) {
    return Eigen::Map<const GltfTransform>(node.matrix.data());  // both by columns
  }
  Vec3 translation = Vec3::Zero(), scale = Vec3::Ones();
  Eigen::Vector4d rotation(0, 0, 0, 1);
  if (node.translation.size() == 3) {
    translation = Eigen::Map<const Vec3>(node.translation.data());
  }
  if (node.rotation.size() == 4) {
    rotation = Eigen::Map<const Eigen::Vector4d>(node.rotation.data());
  }
  if (node.scale.size() == 3) {
    scale = Eigen::Map<const Vec3>(node.scale.data());
  }
  return gltf_transform(translation, rotation, scale);
}

// Joints may be anywhere among the nodes, so all of them are placed. A node below two others or below itself, which
// SceneReader refuses where it is shown, is placed once or stays where it is.
void GltfSkins::place_nodes() {
  const auto exists = [&](int child) { return child >= 0 && static_cast<std::size_t>(child) < model_.nodes.size(); };
  nodes_.resize(model_.nodes.size(), GltfTransform::Identity());
  std::vector<bool> is_child(model_.nodes.size(), false);
  for (const tinygltf::Node& node : model_.nodes) {
    for (const int child : node.children) {
      if (exists(child)) {
        is_child[static_cast<std::size_t>(child)] = true;
      }
    }
  }
  std::vector<std::size_t> waiting;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    nodes_[i] = gltf_local_transform(model_.nodes[i]);
    if (!is_child[i]) {
      waiting.push_back(i);
    }
  }
  while (!waiting.empty()) {
    const std::size_t parent = waiting.back();
    waiting.pop_back();
    for (const int child : model_.nodes[parent].children) {
      if (exists(child) && is_child[static_cast<std::size_t>(child)]) {
        is_child[static_cast<std::size_t>(child)] = false;
        nodes_[static_cast<std::size_t>(child)] = nodes_[parent] * nodes_[static_cast<std::size_t>(child)];
        waiting.push_back(static_cast<std::size_t>(child));
      }
    }
  }
}

std::uint64_t GltfSkins::memory_with(int index) const {
  if (skins_.contains(index)) {
    return memory_;
  }
  constexpr std::uint64_t kOnHeap = 64;
  const tinygltf::Skin& skin = element_at(model_.skins, index, "skin");
  const std::uint64_t nodes = nodes_.empty() ? model_.nodes.size() * (sizeof(GltfTransform) + sizeof(std::size_t)) : 0;
  return memory_ + nodes + skin.joints.size() * sizeof(GltfTransform) + kOnHeap;
}

const std::vector<GltfTransform>& GltfSkins::joints(int index) {
  const tinygltf::Skin& skin = element_at(model_.skins, index, "skin");
  memory_ = memory_with(index);
  const auto [found, is_new] = skins_.try_emplace(index);
  if (!is_new) {
    return found->second;
  }
  if (nodes_.empty()) {
    place_nodes();
  }
  std::vector<GltfTransform>& joints = found->second;
  joints.reserve(skin.joints.size());
  for (const int joint : skin.joints) {
    joints.push_back(element_at(nodes_, joint, "node"));
  }
  if (skin.inverseBindMatrices >= 0) {
    const GltfValues inverse(model_, skin.inverseBindMatrices, TINYGLTF_TYPE_MAT4);
    if (inverse.count() < joints.size()) {
      inverse.fail(fmt::format("holds {} matrices for {} joints", inverse.count(), joints.size()));
    }
    for (std::size_t i = 0; i < joints.size(); ++i) {
      GltfTransform bind;
      for (int k = 0; k < 16; ++k) {
        bind(k % 4, k / 4) = inverse.value(i, static_cast<std::size_t>(k));
      }
      joints[i] = joints[i] * bind;
    }
  }
  return joints;
}

GltfVertices::GltfVertices(const tinygltf::Model& model, const tinygltf::Primitive& primitive, const GltfPose& pose)
    : accessors_{primitive.attributes.at("POSITION")},
      positions_(model, accessors_[0], TINYGLTF_TYPE_VEC3),
      node_(pose.node),
      joints_(pose.joints) {
  read_targets(model, primitive, pose);
  if (joints_ != nullptr) {
    read_joints(model, primitive);
  }
}

// An accessor with values for every vertex.
GltfValues GltfVertices::further(const tinygltf::Model& model, int accessor, int type) {
  GltfValues values(model, accessor, type);
  if (values.count() != count()) {
    values.fail(fmt::format("holds {} values for {} vertices", values.count(), count()));
  }
  accessors_.push_back(accessor);
  return values;
}

void GltfVertices::read_targets(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                                const GltfPose& pose) {
  for (std::size_t i = 0; i < std::min(primitive.targets.size(), pose.weights.size()); ++i) {
    const auto moved = primitive.targets[i].find("POSITION");
    if (moved != primitive.targets[i].end() && pose.weights[i] != 0) {
      targets_.emplace_back(pose.weights[i], further(model, moved->second, TINYGLTF_TYPE_VEC3));
    }
  }
}

void GltfVertices::read_joints(const tinygltf::Model& model, const tinygltf::Primitive& primitive) {
  for (int set = 0;; ++set) {
    const auto joints = primitive.attributes.find("JOINTS_" + std::to_string(set));
    const auto weights = primitive.attributes.find("WEIGHTS_" + std::to_string(set));
    if (joints == primitive.attributes.end() || weights == primitive.attributes.end()) {
      return;
    }
    GltfValues numbers = further(model, joints->second, TINYGLTF_TYPE_VEC4);
    influences_.emplace_back(std::move(numbers), further(model, weights->second, TINYGLTF_TYPE_VEC4));
  }
}

void GltfVertices::check() const {
  positions_.check_order();
  for (const auto& [weight, target] : targets_) {
    target.check_order();
  }
  for (const auto& [joints, weights] : influences_) {
    joints.check_order();
    weights.check_order();
  }
}

Vec3 GltfVertices::position(std::size_t vertex) const {
  Vec3 local = positions_.vector(vertex);
  for (const auto& [weight, target] : targets_) {
    local += weight * target.vector(vertex);
  }
  const Vec3 placed = (transform_of(vertex) * local.homogeneous()).head<3>();
  if (!placed.allFinite()) {
    positions_.fail(fmt::format("holds the vertex {}, which is not finite", vertex));
  }
  return placed;
}

// The mean of the joints by their weights, which add up to 1 but for rounding. What is bound to no joint stays where it
// is written.
GltfTransform GltfVertices::transform_of(std::size_t vertex) const {
  if (joints_ == nullptr) {
    return node_;
  }
  GltfTransform sum = GltfTransform::Zero();
  double total = 0;
  for (const auto& [numbers, weights] : influences_) {
    for (std::size_t i = 0; i < 4; ++i) {
      const double weight = weights.value(vertex, i);
      if (weight == 0) {
        continue;
      }
      const double joint = numbers.value(vertex, i);
      if (!(joint >= 0 && joint < static_cast<double>(joints_->size()))) {
        numbers.fail(fmt::format("holds the joint {}, which is out of range ({} joints)", joint, joints_->size()));
      }
      sum += weight * (*joints_)[static_cast<std::size_t>(joint)];
      total += weight;
    }
  }
  return total == 0 ? GltfTransform(GltfTransform::Identity()) : GltfTransform(sum / total);
}

bool GltfVertices::mirrored() const {
  const bool is_bound = joints_ != nullptr && !influences_.empty() && !joints_->empty();
  const GltfTransform& transform = is_bound ? joints_->front() : node_;
  return transform.topLeftCorner<3, 3>().determinant() < 0;
}

}  // namespace spincat::io
