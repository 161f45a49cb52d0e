#include "spincat/io/formats/gltf_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <iterator>
#include <limits>
#include <map>
#include <new>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "spincat/error.h"
#include "spincat/io/formats/binary.h"
#include "spincat/io/formats/gltf_buffers.h"
#include "spincat/io/formats/gltf_draco.h"
#include "spincat/io/formats/gltf_json.h"
#include "spincat/io/formats/gltf_meshopt.h"
#include "spincat/io/text_cursor.h"

namespace spincat::io {
namespace {

using nlohmann::json;

// A file's two parts: what describes the scene, and in a .glb file the bytes of its first buffer.
struct Container {
  std::string_view text;
  std::optional<std::string_view> binary;
};

Container open_container(std::string_view bytes) {
  constexpr std::uint32_t kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;  // "JSON", "BIN\0"
  if (!bytes.starts_with("glTF")) {
    return {bytes, std::nullopt};
  }
  constexpr std::size_t kHeaderSize = 12, kChunkHeaderSize = 8;
  if (bytes.size() < kHeaderSize) {
    throw InputError("is cut off within its header");
  }
  if (const auto version = load<std::uint32_t>(bytes.data() + 4); version != 2) {
    throw InputError(fmt::format("is a GLB file of version {}; spincat reads version 2", version));
  }
  const std::size_t length = load<std::uint32_t>(bytes.data() + 8);
  if (length > bytes.size()) {
    throw InputError(fmt::format("is cut off: {} of {} bytes", bytes.size(), length));
  }
  bytes.remove_prefix(kHeaderSize);

  Container container;
  while (bytes.size() >= kChunkHeaderSize) {
    const std::size_t size = load<std::uint32_t>(bytes.data());
    const auto type = load<std::uint32_t>(bytes.data() + 4);
    bytes.remove_prefix(kChunkHeaderSize);
    if (size > bytes.size()) {
      throw InputError("is cut off within a chunk");
    }
    if (type == kJsonChunk && container.text.empty()) {
      container.text = bytes.substr(0, size);
    }
    if (type == kBinaryChunk && !container.binary) {
      container.binary = bytes.substr(0, size);
    }
    bytes.remove_prefix(size);
  }
  // Some programs fill the chunk up with zeros where blanks are due.
  while (container.text.ends_with('\0')) {
    container.text.remove_suffix(1);
  }
  return container;
}

// A list holds its old and its new memory for a moment while it grows.
constexpr std::uint64_t kWhileGrowing = 3;

// Looks over the brackets before anything is built from them. tinygltf goes down nested values by recursion: 100,000
// brackets must not exhaust the stack; and each "{}" of a few bytes becomes a hundred in memory. The memory that
// nlohmann's values will take.
std::uint64_t check_brackets(std::string_view text, const ReadLimits& limits) {
  constexpr int kDeepest = 64;
  constexpr std::uint64_t kOnHeap = 64;
  int depth = 0;
  std::uint64_t memory = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (in_string) {
      if (text[i] == '"') {
        in_string = false;
      }
      if (text[i] == '\\') {
        ++i;
      }
    } else if (text[i] == '"') {
      in_string = true;
      memory += kOnHeap;
    } else if (text[i] == ',') {
      memory += kWhileGrowing * sizeof(json);
    } else if (text[i] == '[' || text[i] == '{') {
      if (++depth > kDeepest) {
        throw InputError(fmt::format("its JSON is nested more than {} levels deep", kDeepest));
      }
      memory += kOnHeap + sizeof(json);
    } else if (text[i] == ']' || text[i] == '}') {
      --depth;
    }
  }
  check_growth(memory, text.size(), limits);
  return memory;
}

// What has no part in the shape of an object at rest.
bool is_no_shape(const std::string& key) {
  static constexpr std::array<std::string_view, 11> kKeys{
      "animations", "cameras", "extensionsUsed", "extras",   "images",  "materials",
      "max",        "min",     "name",           "samplers", "textures"};
  return std::find(kKeys.begin(), kKeys.end(), key) != kKeys.end();
}

// Extensions that say where surfaces are.
bool is_read_extension(const std::string& name) {
  static constexpr std::array<std::string_view, 5> kNames{"KHR_draco_mesh_compression", "EXT_meshopt_compression",
                                                          "KHR_meshopt_compression", "EXT_mesh_gpu_instancing",
                                                          "KHR_node_visibility"};
  return std::find(kNames.begin(), kNames.end(), name) != kNames.end();
}

template <class Drop>
void erase_members(json& object, Drop drop) {
  for (auto member = object.begin(); member != object.end();) {
    member = drop(member.key()) ? object.erase(member) : std::next(member);
  }
}

// Recursion is safe here: check_brackets has bounded the depth.
void leave_out_what_is_no_shape(json& value) {
  if (value.is_object()) {
    erase_members(value, is_no_shape);
    if (json* extensions = member(value, "extensions"); extensions != nullptr && extensions->is_object()) {
      erase_members(*extensions, [](const std::string& name) { return !is_read_extension(name); });
    }
  }
  if (value.is_structured()) {
    for (json& part : value) {
      leave_out_what_is_no_shape(part);
    }
  }
}

json parse(std::string_view text) {
  try {
    json document = json::parse(text);
    if (!document.is_object()) {
      throw InputError("is no glTF file: its JSON is not an object");
    }
    return document;
  } catch (const json::parse_error& error) {
    throw InputError(fmt::format("is no valid JSON at byte {}", error.byte));
  } catch (const json::exception&) {
    throw InputError("holds JSON that cannot be read");  // a number beyond all bounds
  }
}

// glTF 1.0 has names where 2.0 has numbers.
void check_version(const json& document) {
  const json* asset = member(document, "asset");
  const json* version = asset != nullptr ? member(*asset, "version") : nullptr;
  std::string text = version != nullptr ? version->is_string() ? version->get<std::string>() : version->dump() : "";
  const json* meshes = member(document, "meshes");
  if (text.empty() && meshes != nullptr && meshes->is_object()) {
    text = "1.0";
  }
  const std::string major = text.substr(0, text.find('.'));
  if (!major.empty() && major != "2") {
    throw InputError(fmt::format("is a glTF file of version {}; spincat reads version 2",
                                 major == "1" || major == "3" ? major : in_quotes(text)));
  }
}

// Extensions that a file declares indispensable but that say nothing about where its surfaces are.
bool is_harmless_extension(const std::string& name) {
  for (const std::string_view prefix : {"KHR_materials_",
                                        "KHR_texture_",
                                        "EXT_texture_",
                                        "MSFT_texture_",
                                        "KHR_image",
                                        "KHR_lights",
                                        "EXT_lights",
                                        "KHR_mesh_quantization",
                                        "KHR_accessor_float64",
                                        "KHR_xmp",
                                        "KHR_techniques_webgl",
                                        "KHR_animation",
                                        "KHR_audio",
                                        "MSFT_audio",
                                        "KHR_physics",
                                        "KHR_interactivity",
                                        "KHR_node_hoverability",
                                        "KHR_node_selectability",
                                        "KHR_environment",
                                        "EXT_environment",
                                        "EXT_mesh_manifold",
                                        "EXT_mesh_features",
                                        "EXT_instance_features",
                                        "EXT_structural_metadata",
                                        "EXT_feature_metadata",
                                        "CESIUM_primitive_outline",
                                        "CESIUM_RTC",
                                        "MSFT_packing_",
                                        "MSFT_lod",
                                        "AGI_",
                                        "ADOBE_",
                                        "NV_materials",
                                        "FB_geometry_metadata",
                                        "GODOT_single_root",
                                        "OMI_",
                                        "VRM"}) {
    if (name.starts_with(prefix)) {
      return true;
    }
  }
  return false;
}

void check_extensions(const json& document) {
  const json* required = member(document, "extensionsRequired");
  if (required == nullptr || !required->is_array()) {
    return;
  }
  for (const json& name : *required) {
    const std::string* text = name.get_ptr<const std::string*>();
    if (text != nullptr && !is_read_extension(*text) && !is_harmless_extension(*text)) {
      throw InputError(fmt::format("needs the glTF extension {}, which spincat does not read", in_quotes(*text)));
    }
  }
}

// tinygltf takes hundreds of bytes for each "{}".
std::uint64_t memory_of(const json& document) {
  constexpr std::size_t kOnHeap = 64;
  std::size_t primitives = 0, targets = 0, weights = 0, joints = 0;
  for (std::size_t i = 0; i < array_size(document, "meshes"); ++i) {
    const json& mesh = document["meshes"][i];
    primitives += array_size(mesh, "primitives");
    weights += array_size(mesh, "weights");
    for (std::size_t k = 0; k < array_size(mesh, "primitives"); ++k) {
      targets += array_size(mesh["primitives"][k], "targets");
    }
  }
  for (std::size_t i = 0; i < array_size(document, "nodes"); ++i) {
    weights += array_size(document["nodes"][i], "weights");
  }
  for (std::size_t i = 0; i < array_size(document, "skins"); ++i) {
    joints += array_size(document["skins"][i], "joints");
  }
  return array_size(document, "nodes") * sizeof(tinygltf::Node) +
         array_size(document, "meshes") * sizeof(tinygltf::Mesh) + primitives * sizeof(tinygltf::Primitive) +
         targets * (sizeof(std::map<std::string, int>) + kOnHeap) + weights * sizeof(double) + joints * sizeof(int) +
         array_size(document, "skins") * sizeof(tinygltf::Skin) +
         array_size(document, "accessors") * sizeof(tinygltf::Accessor) +
         array_size(document, "bufferViews") * sizeof(tinygltf::BufferView) +
         array_size(document, "buffers") * sizeof(tinygltf::Buffer) +
         array_size(document, "scenes") * sizeof(tinygltf::Scene);
}

void erase_extensions(json& value) {
  if (value.is_object()) {
    value.erase("extensions");
  }
  if (value.is_structured()) {
    for (json& part : value) {
      erase_extensions(part);
    }
  }
}

// What EXT_mesh_gpu_instancing and KHR_node_visibility say of the nodes. Takes every extension out of the document:
// tinygltf would take hundreds of bytes for each word of them.
void take_extensions(json& document, GltfDocument& result) {
  for (std::size_t i = 0; i < array_size(document, "nodes"); ++i) {
    const json& node = document["nodes"][i];
    if (const json* instancing = extension(node, "EXT_mesh_gpu_instancing")) {
      const json* attributes = member(*instancing, "attributes");
      const auto accessor = [&](const char* name) {
        const auto number = attributes != nullptr ? number_of(*attributes, name) : std::nullopt;
        return number ? static_cast<int>(std::min<std::uint64_t>(*number, std::numeric_limits<int>::max())) : -1;
      };
      result.instances[i] = {accessor("TRANSLATION"), accessor("ROTATION"), accessor("SCALE")};
    }
    const json* visibility = extension(node, "KHR_node_visibility");
    const json* visible = visibility != nullptr ? member(*visibility, "visible") : nullptr;
    if (visible != nullptr && *visible == false) {
      result.hidden.insert(i);
    }
  }
  erase_extensions(document);
}

// The buffer that goes by this name, or null.
std::string* buffer_at(const std::string& path, void* data) {
  auto& all = *static_cast<std::vector<std::string>*>(data);
  std::size_t number = all.size();
  std::from_chars(path.data(), path.data() + path.size(), number);
  return number < all.size() ? &all[number] : nullptr;
}

// Makes the buffers the only "files" that tinygltf ever gets to see. Newer ones than Debian 12's also ask for sizes, of
// which they have a limit of their own, and read the disk when a single callback is missing.
template <class Reader, class Callbacks>
void let_see(Reader& reader, Callbacks callbacks, std::vector<std::string>& buffers) {
  callbacks.FileExists = [](const std::string&, void*) { return true; };
  callbacks.ExpandFilePath = [](const std::string& path, void*) { return path; };
  callbacks.ReadWholeFile = [](std::vector<unsigned char>* out, std::string*, const std::string& path, void* data) {
    std::string* const buffer = buffer_at(path, data);
    if (buffer == nullptr) {
      return false;
    }
    out->assign(buffer->begin(), buffer->end());
    std::string().swap(*buffer);
    return true;
  };
  callbacks.WriteWholeFile = [](std::string*, const std::string&, const std::vector<unsigned char>&, void*) {
    return false;
  };
  if constexpr (requires { callbacks.GetFileSizeInBytes; }) {
    callbacks.GetFileSizeInBytes = [](std::size_t* size, std::string*, const std::string& path, void* data) {
      const std::string* const buffer = buffer_at(path, data);
      *size = buffer == nullptr ? 0 : buffer->size();
      return buffer != nullptr;
    };
    reader.SetMaxExternalFileSize(std::numeric_limits<std::size_t>::max());
  }
  callbacks.user_data = &buffers;
  reader.SetFsCallbacks(callbacks);
}

// tinygltf's complaints come in several lines, and with bytes of the file in them.
std::string one_line(const std::string& complaint) {
  constexpr std::size_t kLongest = 200;
  std::string line = complaint.substr(0, std::min(complaint.find('\n'), kLongest));
  std::replace_if(
      line.begin(), line.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return line.empty() ? "is no valid glTF file" : "is no valid glTF file: " + line;
}

tinygltf::Model read_model(json document, std::vector<std::string> buffers) {
  const std::string text = document.dump();
  document = json();  // tinygltf makes its own: not both at once
  if (text.size() > std::numeric_limits<std::uint32_t>::max()) {
    throw InputError("holds more than 4 GB of JSON");
  }
  tinygltf::TinyGLTF reader;
  let_see(reader, tinygltf::FsCallbacks{}, buffers);
  reader.SetImageLoader([](tinygltf::Image*, int, std::string*, std::string*, int, int, const unsigned char*, int,
                           void*) { return true; },
                        nullptr);
  tinygltf::Model model;
  std::string error, warning;
  bool read = false;
  try {
    read = reader.LoadASCIIFromString(&model, &error, &warning, text.data(), static_cast<unsigned>(text.size()), "");
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& exception) {
    error = exception.what();
  }
  if (!read) {
    throw InputError(one_line(error));
  }
  return model;
}

}  // namespace

GltfDocument read_gltf_document(std::string_view bytes, const std::filesystem::path& folder, const ReadLimits& limits) {
  const Container container = open_container(bytes);
  const std::uint64_t memory_of_values = check_brackets(container.text, limits);
  json document = parse(container.text);
  check_version(document);
  leave_out_what_is_no_shape(document);
  check_extensions(document);
  GltfBuffers source(document, container.binary, folder);
  const BufferSizes sizes = source.measure();
  GltfDocument result;
  result.file_size = bytes.size() + sizes.files;
  result.memory = kWhileGrowing * memory_of(document) + sizes.memory;
  // Each buffer is there twice while tinygltf takes it over, and unpacking takes time where it takes no memory.
  check_growth(memory_of_values + result.memory + sizes.largest + meshopt_size(document), result.file_size, limits);
  std::vector<std::string> buffers = source.collect();
  unpack_meshopt(document, buffers);
  result.memory += unpack_draco_primitives(document, buffers, [&](std::uint64_t more) {
    check_growth(memory_of_values + result.memory + more, result.file_size, limits);
  });
  take_extensions(document, result);
  result.model = read_model(std::move(document), std::move(buffers));
  return result;
}

}  // namespace spincat::io
