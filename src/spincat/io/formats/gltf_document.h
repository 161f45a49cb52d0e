// The outer shell of glTF: from the bytes of a file to tinygltf's model. Private to io.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

#ifndef TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE
#endif
#ifndef TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#endif
#ifndef TINYGLTF_NO_EXTERNAL_IMAGE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#endif
#include <tiny_gltf.h>

#include "spincat/io/read_limits.h"

namespace spincat::io {

struct GltfDocument {
  tinygltf::Model model;
  std::uint64_t file_size;  // bytes of the file and of what is read of the files with its buffers, each counted once
  std::uint64_t memory;     // what the model may take, but for buffers written into the file (data:)
};

// Reads a .gltf or .glb file with every buffer it needs. Everything that is no shape (images, materials, animations,
// ...) is left out before tinygltf sees it, so images are neither needed nor loaded. Buffers in files of their own must
// lie in or below `folder`. Nothing in the model is checked beyond its syntax: indices and offsets may be anything.
// Throws InputError, also when it describes far more than a file of its size has any use for (check_growth).
GltfDocument read_gltf_document(std::string_view bytes, const std::filesystem::path& folder, const ReadLimits& limits);

}  // namespace spincat::io
