#include "spincat/io/formats/gltf_document.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cerrno>
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
#include "spincat/files/file.h"
#include "spincat/files/system_error_text.h"
#include "spincat/io/formats/binary.h"
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
  static constexpr std::array<std::string_view, 15> kEys{
      "animations", "cameras", "extensions", "extensionsUsed", "extras",  "images",   "materials", "max",
      "min",        "name",    "samplers",   "skins",          "targets", "textures", "weights"};
  return std::find(kEys.begin(), kEys.end(), key) != kEys.end();
}

// Recursion is safe here: check_brackets has bounded the depth.
void leave_out_what_is_no_shape(json& value) {
  if (value.is_object()) {
    for (auto member = value.begin(); member != value.end();) {
      member = is_no_shape(member.key()) ? value.erase(member) : std::next(member);
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
    leave_out_what_is_no_shape(document);
    return document;
  } catch (const json::parse_error& error) {
    throw InputError(fmt::format("is no valid JSON at byte {}", error.byte));
  } catch (const json::exception&) {
    throw InputError("holds JSON that cannot be read");  // a number beyond all bounds
  }
}

// Extensions that a file declares indispensable but that say nothing about where its surfaces are.
bool is_harmless_extension(const std::string& name) {
  for (const std::string_view prefix : {"KHR_materials_", "KHR_texture_", "EXT_texture_", "MSFT_texture_",
                                        "KHR_lights_punctual", "KHR_mesh_quantization", "KHR_xmp"}) {
    if (name.starts_with(prefix)) {
      return true;
    }
  }
  return false;
}

void check_extensions(const json& document) {
  const auto required = document.find("extensionsRequired");
  if (required == document.end() || !required->is_array()) {
    return;
  }
  for (const json& name : *required) {
    if (name.is_string() && !is_harmless_extension(name.get<std::string>())) {
      throw InputError(
          fmt::format("needs the glTF extension {}, which spincat does not read", in_quotes(name.get<std::string>())));
    }
  }
}

std::size_t array_size(const json& object, const char* key) {
  const auto found = object.is_object() ? object.find(key) : object.end();
  return found != object.end() && found->is_array() ? found->size() : 0;
}

// tinygltf takes hundreds of bytes for each "{}".
std::uint64_t memory_of(const json& document) {
  std::size_t primitives = 0;
  for (std::size_t i = 0; i < array_size(document, "meshes"); ++i) {
    primitives += array_size(document["meshes"][i], "primitives");
  }
  return array_size(document, "nodes") * sizeof(tinygltf::Node) +
         array_size(document, "meshes") * sizeof(tinygltf::Mesh) + primitives * sizeof(tinygltf::Primitive) +
         array_size(document, "accessors") * sizeof(tinygltf::Accessor) +
         array_size(document, "bufferViews") * sizeof(tinygltf::BufferView) +
         array_size(document, "buffers") * sizeof(tinygltf::Buffer) +
         array_size(document, "scenes") * sizeof(tinygltf::Scene);
}

// %20 and the like in a URI.
std::string decode_percent(std::string_view uri) {
  std::string text;
  while (!uri.empty()) {
    const std::string_view digits = uri.substr(1, 2);
    unsigned value = 0;
    const auto end = std::from_chars(digits.data(), digits.data() + digits.size(), value, 16).ptr;
    const bool coded = uri[0] == '%' && digits.size() == 2 && end == digits.data() + 2;
    text += coded ? static_cast<char>(value) : uri[0];
    uri.remove_prefix(coded ? 3 : 1);
  }
  return text;
}

std::filesystem::path path_beside(const std::filesystem::path& folder, const std::string& uri) {
  const std::filesystem::path relative = std::filesystem::path(decode_percent(uri)).lexically_normal();
  const bool outside = relative.is_absolute() || relative.empty() || *relative.begin() == "..";
  if (outside || relative.native().find('\0') != std::string::npos) {
    throw InputError(fmt::format("its buffer {} does not lie in the file's own folder", in_quotes(uri)));
  }
  return folder / relative;
}

struct stat status_beside(const std::filesystem::path& folder, const std::string& uri) {
  struct stat status = {};
  if (::stat(path_beside(folder, uri).c_str(), &status) != 0) {
    throw InputError(fmt::format("its buffer {}: {}", in_quotes(uri), system_error_text(errno)));
  }
  if (!S_ISREG(status.st_mode)) {
    throw InputError(fmt::format("its buffer {} is no regular file", in_quotes(uri)));
  }
  return status;
}

std::string read_beside(const std::filesystem::path& folder, const std::string& uri, std::uint64_t length) {
  try {
    return read_file(path_beside(folder, uri), length);
  } catch (const InputError& unread) {
    throw InputError(fmt::format("its buffer {}: {}", in_quotes(uri), unread.problem()));
  }
}

std::uint64_t length_of(const json& buffer, std::size_t number) {
  const auto length = buffer.is_object() ? buffer.find("byteLength") : buffer.end();
  if (length == buffer.end() || !length->is_number_unsigned()) {
    throw InputError(fmt::format("its buffer {} has no byteLength", number));
  }
  return length->get<std::uint64_t>();
}

const std::string* uri_of(const json& buffer) {
  const auto uri = buffer.find("uri");
  return uri != buffer.end() ? uri->get_ptr<const std::string*>() : nullptr;
}

void check_whole(std::size_t number, std::uint64_t size, std::uint64_t length) {
  if (size < length) {
    throw InputError(fmt::format("its buffer {} is cut off: {} of {} bytes", number, size, length));
  }
}

// In bytes. Buffers written into the text (data:) do not count: they are as long as it.
struct BufferSizes {
  std::uint64_t memory = 0;  // that all of them take
  std::uint64_t largest = 0;
  std::uint64_t files = 0;  // what is read of the files beside, each counted once
};

// Looks the buffers up without reading them: a few bytes of text name one, any number of them may name the same file,
// and that may be of any size.
BufferSizes measure_buffers(const json& document, const Container& container, const std::filesystem::path& folder) {
  constexpr std::uint64_t kMost = std::uint64_t{1} << 60;  // beyond all memory; sums stay below the largest number
  BufferSizes sizes;
  std::map<std::pair<dev_t, ino_t>, std::uint64_t> read_of_file;  // by which it is known under all its names
  for (std::size_t i = 0; i < array_size(document, "buffers"); ++i) {
    const json& buffer = document["buffers"][i];
    const std::uint64_t length = length_of(buffer, i);
    const std::string* uri = uri_of(buffer);
    if (uri != nullptr && tinygltf::IsDataURI(*uri)) {
      continue;
    }
    if (uri != nullptr) {
      const struct stat status = status_beside(folder, *uri);
      check_whole(i, static_cast<std::uint64_t>(status.st_size), length);
      std::uint64_t& read = read_of_file[{status.st_dev, status.st_ino}];
      const std::uint64_t before = std::exchange(read, std::max(read, length));
      sizes.files = std::min(kMost, sizes.files + read - before);
    } else {
      check_whole(i, i == 0 && container.binary ? container.binary->size() : 0, length);
    }
    sizes.memory = std::min(kMost, sizes.memory + length);
    sizes.largest = std::min(kMost, std::max(sizes.largest, length));
  }
  return sizes;
}

// The bytes of every buffer, after measure_buffers. Leaves its number where its URI was, by which tinygltf asks for it
// below. Buffers written into the file itself (data:) stay.
std::vector<std::string> collect_buffers(json& document, const Container& container,
                                         const std::filesystem::path& folder) {
  std::vector<std::string> buffers(array_size(document, "buffers"));
  for (std::size_t i = 0; i < buffers.size(); ++i) {
    json& buffer = document["buffers"][i];
    const std::uint64_t length = length_of(buffer, i);
    const std::string* uri = uri_of(buffer);
    if (uri != nullptr && tinygltf::IsDataURI(*uri)) {
      continue;
    }
    if (uri != nullptr) {
      buffers[i] = read_beside(folder, *uri, length);
    } else if (container.binary) {
      buffers[i] = container.binary->substr(0, length);
    }
    check_whole(i, buffers[i].size(), length);  // files may have changed
    buffer["uri"] = std::to_string(i);
  }
  return buffers;
}

// The only "files" that tinygltf ever gets to see.
tinygltf::FsCallbacks callbacks_for(std::vector<std::string>& buffers) {
  tinygltf::FsCallbacks callbacks = {};
  callbacks.FileExists = [](const std::string&, void*) { return true; };
  callbacks.ExpandFilePath = [](const std::string& path, void*) { return path; };
  callbacks.ReadWholeFile = [](std::vector<unsigned char>* out, std::string*, const std::string& path, void* data) {
    auto& all = *static_cast<std::vector<std::string>*>(data);
    std::size_t number = all.size();
    std::from_chars(path.data(), path.data() + path.size(), number);
    if (number >= all.size()) {
      return false;
    }
    out->assign(all[number].begin(), all[number].end());
    std::string().swap(all[number]);
    return true;
  };
  callbacks.user_data = &buffers;
  return callbacks;
}

// tinygltf's complaints come in several lines, and with bytes of the file in them.
std::string one_line(const std::string& complaint) {
  constexpr std::size_t kLongest = 200;
  std::string line = complaint.substr(0, std::min(complaint.find('\n'), kLongest));
  std::replace_if(
      line.begin(), line.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return line.empty() ? "is no valid glTF file" : "is no valid glTF file: " + line;
}

}  // namespace

GltfDocument read_gltf_document(std::string_view bytes, const std::filesystem::path& folder, const ReadLimits& limits) {
  const Container container = open_container(bytes);
  const std::uint64_t memory_of_values = check_brackets(container.text, limits);
  json document = parse(container.text);
  check_extensions(document);
  const BufferSizes sizes = measure_buffers(document, container, folder);
  const std::uint64_t size = bytes.size() + sizes.files;
  const std::uint64_t memory = kWhileGrowing * memory_of(document) + sizes.memory;
  // Each buffer is there twice while tinygltf takes it over.
  check_growth(memory_of_values + memory + sizes.largest, size, limits);
  std::vector<std::string> buffers = collect_buffers(document, container, folder);
  const std::string text = document.dump();
  document = json();  // tinygltf makes its own: not both at once
  if (text.size() > std::numeric_limits<std::uint32_t>::max()) {
    throw InputError("holds more than 4 GB of JSON");
  }

  tinygltf::TinyGLTF reader;
  reader.SetFsCallbacks(callbacks_for(buffers));
  reader.SetImageLoader([](tinygltf::Image*, int, std::string*, std::string*, int, int, const unsigned char*, int,
                           void*) { return true; },
                        nullptr);
  GltfDocument result{{}, size, memory};
  std::string error, warning;
  bool read = false;
  try {
    read = reader.LoadASCIIFromString(&result.model, &error, &warning, text.data(), static_cast<unsigned>(text.size()),
                                      "");
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& exception) {
    error = exception.what();
  }
  if (!read) {
    throw InputError(one_line(error));
  }
  return result;
}

}  // namespace spincat::io
