// EXT_meshopt_compression and KHR_meshopt_compression: bufferViews that meshoptimizer has compressed. Private to io.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace spincat::io {

// The bytes that unpacking will write, each as often as a bufferView has it written.
std::uint64_t meshopt_size(const nlohmann::json& document);

// Unpacks every compressed bufferView to where it lies in its buffer, one of GltfBuffers::collect(). Throws InputError
// where that is damaged or has no room.
void unpack_meshopt(const nlohmann::json& document, std::vector<std::string>& buffers);

}  // namespace spincat::io
