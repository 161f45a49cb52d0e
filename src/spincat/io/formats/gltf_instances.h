// EXT_mesh_gpu_instancing: where a node shows its mesh again and again. Private to io.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "spincat/io/formats/gltf_values.h"
#include "spincat/io/formats/gltf_vertices.h"

namespace spincat::io {

class GltfInstances {
 public:
  // accessors: of translations, rotations and scales; -1 where there is none. Throws InputError where they are not of
  // one length.
  GltfInstances(const tinygltf::Model& model, const std::array<int, 3>& accessors);

  std::size_t count() const { return count_; }
  GltfTransform transform(std::size_t instance) const;  // relative to the node

 private:
  std::array<std::optional<GltfValues>, 3> values_;
  std::size_t count_ = 0;
};

}  // namespace spincat::io
