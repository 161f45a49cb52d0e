// Meshes that Draco has compressed. Private to io.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "spincat/io/formats/binary.h"

namespace spincat::io {

struct DracoAttribute {
  ScalarType type = ScalarType::float32;  // one that glTF knows
  std::size_t components = 0;
  std::string values;  // of every point, one behind the other
};

struct DracoMesh {
  std::size_t points = 0;
  std::size_t triangles = 0;
  std::string corners;  // three indices of 32 bits for each triangle
  std::map<std::string, DracoAttribute> attributes;
};

// Whether this spincat was built with Draco.
bool has_draco();

// Unpacks the attributes that have the ids wanted, under their names. expect_memory is told how many bytes all of it
// will take before they are taken, and may throw; it is called more than once, with more each time. Throws InputError
// (a sentence that begins with its problem) when the mesh is damaged, of another version than 2.2 or lacks an
// attribute.
DracoMesh unpack_draco(std::string_view packed, const std::map<std::string, std::uint32_t>& wanted,
                       const std::function<void(std::uint64_t)>& expect_memory);

}  // namespace spincat::io
