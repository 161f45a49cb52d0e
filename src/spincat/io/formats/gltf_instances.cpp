#include "spincat/io/formats/gltf_instances.h"

#include <fmt/format.h>

#include "spincat/error.h"

namespace spincat::io {

GltfInstances::GltfInstances(const tinygltf::Model& model, const std::array<int, 3>& accessors) {
  constexpr std::array<int, 3> kTypes = {TINYGLTF_TYPE_VEC3, TINYGLTF_TYPE_VEC4, TINYGLTF_TYPE_VEC3};
  bool is_first = true;
  for (std::size_t i = 0; i < values_.size(); ++i) {
    if (accessors[i] < 0) {
      continue;
    }
    const GltfValues& values = values_[i].emplace(model, accessors[i], kTypes[i]);
    if (!is_first && values.count() != count_) {
      values.fail(fmt::format("holds {} values for {} instances", values.count(), count_));
    }
    count_ = values.count();
    is_first = false;
  }
}

GltfTransform GltfInstances::transform(std::size_t instance) const {
  const auto& [translations, rotations, scales] = values_;
  Vec3 translation = Vec3::Zero(), scale = Vec3::Ones();
  Eigen::Vector4d rotation(0, 0, 0, 1);
  if (translations) {
    translation = translations->vector(instance);
  }
  if (rotations) {
    rotation << rotations->vector(instance), rotations->value(instance, 3);
  }
  if (scales) {
    scale = scales->vector(instance);
  }
  return gltf_transform(translation, rotation, scale);
}

}  // namespace spincat::io
