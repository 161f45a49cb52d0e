#include "spincat/io/formats/gltf_draco.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

#include "spincat/error.h"
#include "spincat/io/formats/draco_mesh.h"
#include "spincat/io/formats/gltf_buffers.h"
#include "spincat/io/formats/gltf_json.h"
#include "spincat/io/text_cursor.h"

namespace spincat::io {
namespace {

using nlohmann::json;

constexpr const char* kExtension = "KHR_draco_mesh_compression";

int component_type(ScalarType type) {
  switch (type) {
    case ScalarType::int8:
      return 5120;
    case ScalarType::uint8:
      return 5121;
    case ScalarType::int16:
      return 5122;
    case ScalarType::uint16:
      return 5123;
    case ScalarType::uint32:
      return 5125;
    default:
      return 5126;
  }
}

// What has a part in where vertices are.
bool is_shape(std::string_view attribute) {
  return attribute == "POSITION" || attribute.starts_with("JOINTS_") || attribute.starts_with("WEIGHTS_");
}

class Unpacker {
 public:
  Unpacker(json& document, std::vector<std::string>& buffers, const std::function<void(std::uint64_t)>& expect_memory)
      : document_(document), buffers_(buffers), expect_memory_(expect_memory) {}

  void unpack(json& primitive) {
    const json* packed = extension(primitive, kExtension);
    if (packed == nullptr || has_data_of_its_own(primitive)) {
      return;
    }
    const std::uint64_t number = number_of(*packed, "bufferView").value_or(array_size(document_, "bufferViews"));
    const json* view = element(std::as_const(document_), "bufferViews", number);
    const std::optional<std::string_view> bytes = view != nullptr ? view_bytes(*view, buffers_) : std::nullopt;
    if (!bytes) {
      throw InputError(fmt::format("its bufferView {} does not exist or reaches beyond its buffer", number));
    }
    taken_ += kForEachPrimitive + bytes->size();  // many primitives may name it, and each has it unpacked
    DracoMesh mesh =
        unpack_draco(*bytes, wanted(*packed), [&](std::uint64_t memory) { expect_memory_(taken_ + memory); });
    replace_accessors(primitive, std::move(mesh));
  }

  std::uint64_t taken() const { return taken_; }

 private:
  // What the accessors of a primitive take, in JSON and in tinygltf's model.
  static constexpr std::uint64_t kForEachPrimitive = 6'000;

  bool has_data(const json* index) const {
    const json* accessor = index != nullptr && index->is_number_unsigned()
                               ? element(std::as_const(document_), "accessors", index->get<std::uint64_t>())
                               : nullptr;
    return accessor != nullptr && member(*accessor, "bufferView") != nullptr;
  }

  bool has_data_of_its_own(const json& primitive) const {
    const json* attributes = member(primitive, "attributes");
    const json* indices = member(primitive, "indices");
    return attributes != nullptr && has_data(member(*attributes, "POSITION")) &&
           (indices == nullptr || has_data(indices));
  }

  static std::map<std::string, std::uint32_t> wanted(const json& packed) {
    std::map<std::string, std::uint32_t> ids;
    const json* attributes = member(packed, "attributes");
    if (attributes != nullptr && attributes->is_object()) {
      for (const auto& [name, id] : attributes->items()) {
        if (is_shape(name) && id.is_number_unsigned()) {
          ids.emplace(name, id.template get<std::uint32_t>());
        }
      }
    }
    if (!ids.contains("POSITION")) {
      throw InputError("holds a Draco mesh without positions");
    }
    return ids;
  }

  void replace_accessors(json& primitive, DracoMesh mesh) {
    json& attributes = primitive["attributes"];
    if (!attributes.is_object()) {
      attributes = json::object();
    }
    taken_ += mesh.corners.size();
    primitive["indices"] = add_accessor(std::move(mesh.corners), 5125, 1, 3 * mesh.triangles, false);
    primitive["mode"] = 4;  // triangles, whatever it was before it was compressed
    for (auto& [name, attribute] : mesh.attributes) {
      const json* before =
          element(std::as_const(document_), "accessors", number_of(attributes, name.c_str()).value_or(UINT64_MAX));
      const json* normalized = before != nullptr ? member(*before, "normalized") : nullptr;
      taken_ += attribute.values.size();
      attributes[name] = add_accessor(std::move(attribute.values), component_type(attribute.type), attribute.components,
                                      mesh.points, normalized != nullptr && *normalized == true);
    }
  }

  std::size_t add_accessor(std::string bytes, int type, std::size_t components, std::size_t count, bool normalized) {
    static constexpr std::array<const char*, 5> kTypes = {"", "SCALAR", "VEC2", "VEC3", "VEC4"};
    if (components == 0 || components >= kTypes.size()) {
      throw InputError(fmt::format("holds a Draco mesh whose values have {} components", components));
    }
    json& accessors = document_["accessors"];
    if (!accessors.is_array()) {
      accessors = json::array();
    }
    document_["buffers"].push_back({{"byteLength", bytes.size()}, {"uri", std::to_string(buffers_.size())}});
    document_["bufferViews"].push_back({{"buffer", buffers_.size()}, {"byteLength", bytes.size()}});
    accessors.push_back({{"bufferView", document_["bufferViews"].size() - 1},
                         {"componentType", type},
                         {"type", kTypes[components]},
                         {"count", count},
                         {"normalized", normalized}});
    buffers_.push_back(std::move(bytes));
    return accessors.size() - 1;
  }

  json& document_;
  std::vector<std::string>& buffers_;
  const std::function<void(std::uint64_t)>& expect_memory_;
  std::uint64_t taken_ = 0;
};

}  // namespace

std::uint64_t unpack_draco_primitives(json& document, std::vector<std::string>& buffers,
                                      const std::function<void(std::uint64_t)>& expect_memory) {
  Unpacker unpacker(document, buffers, expect_memory);
  for (std::size_t i = 0; i < array_size(document, "meshes"); ++i) {
    json& mesh = *element(document, "meshes", i);
    for (std::size_t k = 0; k < array_size(mesh, "primitives"); ++k) {
      json& primitive = *element(mesh, "primitives", k);
      unpacker.unpack(primitive);
    }
  }
  return unpacker.taken();
}

}  // namespace spincat::io
