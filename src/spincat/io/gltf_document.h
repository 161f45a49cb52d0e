// The outer shell of glTF: from the bytes of a file to tinygltf's model. Private to io.
#pragma once

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

namespace spincat::io {

// Reads a .gltf or .glb file with every buffer it needs. Everything that is no shape (images, materials, animations,
// ...) is left out before tinygltf sees it, so images are neither needed nor loaded. Buffers in files of their own must
// lie in or below `folder`. Nothing in the model is checked beyond its syntax: indices and offsets may be anything.
// Throws InputError.
tinygltf::Model read_gltf_document(std::string_view bytes, const std::filesystem::path& folder);

}  // namespace spincat::io
