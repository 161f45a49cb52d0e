// The outer shell of glTF: from the bytes of a file to tinygltf's model. Private to io.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
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
  std::map<std::size_t, std::array<int, 3>> instances;  // of a node: accessors of translations, rotations and scales
                                                        // (-1: none) by which it is shown several times
  std::set<std::size_t> hidden;                         // nodes that are not to be seen, with all below them
  std::uint64_t file_size =
      0;                     // bytes of the file and of what is read of the files with its buffers, each counted once
  std::uint64_t memory = 0;  // what the model may take
};

// Reads a .gltf or .glb file with every buffer it needs. Everything that is no shape (images, materials, animations,
// ...) is left out before tinygltf sees it, so images are neither needed nor loaded. Compressed data is unpacked.
// Buffers in files of their own must lie in or below `folder`. Nothing in the model is checked beyond its syntax:
// indices and offsets may be anything. Throws InputError, also when it describes far more than a file of its size has
// any use for (check_growth).
GltfDocument read_gltf_document(std::string_view bytes, const std::filesystem::path& folder, const ReadLimits& limits);

}  // namespace spincat::io
