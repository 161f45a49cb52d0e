// A square as a glTF file, for the tests of all that such files may hold.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "io/bytes.h"
#include "io/reading.h"

namespace spincat::test {

using nlohmann::json;

inline const std::vector<Vec3> kSquareVertices{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
inline const std::vector<Triangle> kSquareTriangles{{0, 1, 2}, {0, 2, 3}};

inline std::string base64(const std::string& bytes) {
  static const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      bits = bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += i + k <= bytes.size() ? digits[bits >> (18 - 6 * k) & 63] : '=';
    }
  }
  return text;
}

// 4 vertices of 3 floats, then 6 indices of 2 bytes: 60 bytes.
inline std::string square_buffer() {
  std::string bytes;
  for (const Vec3& vertex : kSquareVertices) {
    for (const double c : vertex) {
      bytes += little(static_cast<float>(c));
    }
  }
  for (const Triangle& triangle : kSquareTriangles) {
    for (const std::uint32_t corner : triangle) {
      bytes += little(static_cast<std::uint16_t>(corner));
    }
  }
  return bytes;
}

inline json square_document(const std::string& uri) {
  json document = json::parse(R"({
    "asset": {"version": "2.0"},
    "scene": 0,
    "scenes": [{"nodes": [0]}],
    "nodes": [{"mesh": 0}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
                  {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"}],
    "bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 12}],
    "buffers": [{"byteLength": 60}]})");
  if (!uri.empty()) {
    document["buffers"][0]["uri"] = uri;
  }
  return document;
}

// With its buffer in the text.
inline json square_document() {
  return square_document("data:application/octet-stream;base64," + base64(square_buffer()));
}

inline std::string glb(std::string text, const std::string& binary) {
  while (text.size() % 4 != 0) {
    text += ' ';
  }
  const auto size = [](std::size_t bytes) { return little(static_cast<std::uint32_t>(bytes)); };
  return "glTF" + size(2) + size(12 + 8 + text.size() + 8 + binary.size()) + size(text.size()) + "JSON" + text +
         size(binary.size()) + std::string("BIN\0", 4) + binary;
}

inline Mesh read_document(const json& document) {
  return read_mesh("a.gltf", document.dump());
}

inline std::string problem_of(const json& document) {
  return problem_with("a.gltf", document.dump());
}

inline void expect_square(const Mesh& mesh) {
  EXPECT_EQ(mesh.vertices, kSquareVertices);
  EXPECT_EQ(mesh.triangles, kSquareTriangles);
}

// The document with a buffer of its own in the text; its number.
inline std::size_t add_buffer(json& document, const std::string& bytes) {
  document["buffers"].push_back(
      {{"byteLength", bytes.size()}, {"uri", "data:application/octet-stream;base64," + base64(bytes)}});
  return document["buffers"].size() - 1;
}

// The number of a bufferView of just these bytes.
inline std::size_t add_view(json& document, const std::string& bytes) {
  const std::size_t buffer = add_buffer(document, bytes);
  document["bufferViews"].push_back({{"buffer", buffer}, {"byteLength", bytes.size()}});
  return document["bufferViews"].size() - 1;
}

// The number of an accessor of just these bytes.
inline std::size_t add_accessor(json& document, const std::string& bytes, int component_type, const char* type,
                                std::size_t count) {
  const std::size_t view = add_view(document, bytes);
  document["accessors"].push_back(
      {{"bufferView", view}, {"componentType", component_type}, {"type", type}, {"count", count}});
  return document["accessors"].size() - 1;
}

template <class... Numbers>
std::string floats(Numbers... numbers) {
  return little_row<float>(numbers...);
}

}  // namespace spincat::test
