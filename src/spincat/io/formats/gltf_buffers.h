// The bytes of glTF buffers: in the binary part of a .glb file, in the text (data:) or in files beside. Private to io.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace spincat::io {

// In bytes.
struct BufferSizes {
  std::uint64_t memory = 0;  // that all of them take
  std::uint64_t largest = 0;
  std::uint64_t files = 0;  // what is read of the files beside, each counted once
};

// binary: the bytes of a .glb file's first buffer.
class GltfBuffers {
 public:
  GltfBuffers(nlohmann::json& document, std::optional<std::string_view> binary, std::filesystem::path folder);

  // Looks the buffers up without reading them: a few bytes of text name one, any number of them may name the same file,
  // and that may be of any size. Throws InputError where one is not there or too short.
  BufferSizes measure() const;

  // The bytes of every buffer, after measure(). Leaves its number where its URI was. Those that hold nothing but room
  // for what meshoptimizer has compressed ("fallback") are all zeros.
  std::vector<std::string> collect();

 private:
  bool is_room(std::size_t number) const;

  nlohmann::json& document_;
  std::optional<std::string_view> binary_;
  std::filesystem::path folder_;
  std::vector<bool> unpacked_into_;  // whether a compressed bufferView goes there
};

// The bytes of a bufferView; none where it is none or does not lie in its buffer.
std::optional<std::string_view> view_bytes(const nlohmann::json& view, const std::vector<std::string>& buffers);

}  // namespace spincat::io
