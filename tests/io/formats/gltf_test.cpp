#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "io/formats/gltf_square.h"
#include "support/expect_error.h"

namespace spincat {
namespace {

using namespace test;
using nlohmann::json;

TEST(Gltf, ReadsABufferInTheFile) {
  expect_square(read_document(square_document()));
}

TEST(Gltf, ReadsBinaryFiles) {
  expect_square(read_mesh("a.glb", glb(square_document("").dump(), square_buffer())));
  expect_square(read_mesh("a.glb", glb(square_document("").dump(), square_buffer() + "pad.")));
  expect_square(read_mesh("a.gltf", glb(square_document("").dump(), square_buffer())));
  expect_square(read_mesh("a.glb", glb(square_document("").dump() + std::string(3, '\0'), square_buffer())));
}

TEST(Gltf, ReadsABufferBesideTheFile) {
  const test::TempDir dir;
  dir.write("parts/a buffer.bin", square_buffer() + "more");
  for (const char* uri : {"parts/a%20buffer.bin", "./parts/a buffer.bin", "parts/../parts/a%20buffer.bin"}) {
    expect_square(std::get<Mesh>(read_object(dir.write("a.gltf", square_document(uri).dump()))));
  }
}

TEST(Gltf, StaysInItsOwnFolder) {
  const test::TempDir dir;
  dir.write("secret.bin", square_buffer());
  for (const std::string& uri : {std::string("../secret.bin"), std::string("x/../../secret.bin"),
                                 std::string("%2e%2e/secret.bin"), (dir / "secret.bin").string()}) {
    const auto file = dir.write("folder/a.gltf", square_document(uri).dump());
    try {
      read_object(file);
      ADD_FAILURE() << uri;
    } catch (const InputError& error) {
      EXPECT_TRUE(error.problem().ends_with("does not lie in the file's own folder")) << error.what();
    }
  }
  EXPECT_EQ(problem_of(square_document("missing.bin")), "its buffer 'missing.bin': no such file");
  EXPECT_EQ(problem_of(square_document(".")), "its buffer '.' is no regular file");
  EXPECT_EQ(problem_of(square_document("http://host/a.bin")), "its buffer 'http://host/a.bin': no such file");
}

TEST(Gltf, NeverNeedsImages) {
  json document = square_document();
  document["images"] = {{{"uri", "missing.png"}}, {{"bufferView", 0}, {"mimeType", "image/png"}}, {{"bufferView", 99}}};
  document["textures"] = {{{"source", 0}}};
  document["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
  document["animations"] = 7;
  document["extras"] = {1, {2, {3}}};
  expect_square(read_document(document));
}

TEST(Gltf, PlacesNodesByTranslationRotationAndScale) {
  json document = square_document();
  document["nodes"] = {
      {{"children", {1}}, {"translation", {10, 0, 0}}},
      {{"mesh", 0}, {"rotation", {0, 0, 0.70710678118654752, 0.70710678118654752}}, {"scale", {2, 3, 1}}}};
  expect_near(read_document(document).vertices, {{10, 0, 0}, {10, 2, 0}, {7, 2, 0}, {7, 0, 0}});
}

TEST(Gltf, PlacesNodesByMatrix) {
  json document = square_document();
  document["nodes"] = {{{"mesh", 0}, {"matrix", {0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1}}}};
  EXPECT_EQ(read_document(document).vertices, (std::vector<Vec3>{{5, 6, 7}, {5, 7, 7}, {4, 7, 7}, {4, 6, 7}}));
}

TEST(Gltf, TurnsMirroredFacesBack) {
  json document = square_document();
  document["nodes"] = {{{"mesh", 0}, {"scale", {-1, 1, 1}}}};
  EXPECT_EQ(read_document(document).triangles, (std::vector<Triangle>{{0, 2, 1}, {0, 3, 2}}));
}

TEST(Gltf, PlacesOneMeshManyTimes) {
  json document = square_document();
  document["scenes"][0]["nodes"] = {0, 1};
  document["nodes"] = {{{"mesh", 0}}, {{"mesh", 0}, {"translation", {0, 0, 5}}}};
  const Mesh mesh = read_document(document);
  EXPECT_EQ(mesh.vertices.size(), 8U);
  EXPECT_EQ(mesh.vertices[4], Vec3(0, 0, 5));
  EXPECT_EQ(mesh.triangles[2], (Triangle{4, 5, 6}));
  EXPECT_EQ(problem_with("a.gltf", document.dump(), {.max_points = 7}),
            "holds more than 7 points; --max-points raises this limit");
}

TEST(Gltf, ShowsTheDefaultSceneOnly) {
  json document = square_document();
  document["nodes"] = {{{"mesh", 99}}, {{"mesh", 0}}};
  document["scenes"] = {{{"nodes", {0}}}, {{"nodes", {1}}}};
  document["scene"] = 1;
  expect_square(read_document(document));
}

TEST(Gltf, DoesWithoutScenesAndNodes) {
  json document = square_document();
  document.erase("scene");
  document.erase("scenes");
  document["nodes"] = {{{"mesh", 0}}, {{"children", {0}}, {"translation", {1, 0, 0}}}};
  EXPECT_EQ(read_document(document).vertices[0], Vec3(1, 0, 0));
  document.erase("nodes");
  expect_square(read_document(document));
}

TEST(Gltf, LeavesSkinnedMeshesAtRest) {
  json document = square_document();
  document["nodes"] = {{{"mesh", 0}, {"skin", 0}, {"translation", {1, 0, 0}}}};
  expect_square(read_document(document));
}

TEST(Gltf, SharesVerticesBetweenPrimitives) {
  json document = square_document();
  json primitive = document["meshes"][0]["primitives"][0];
  document["meshes"][0]["primitives"].push_back(primitive);
  const Mesh mesh = read_document(document);
  EXPECT_EQ(mesh.vertices.size(), 4U);
  EXPECT_EQ(mesh.triangles.size(), 4U);
}

TEST(Gltf, ReadsStripsFansAndUnindexedTriangles) {
  json document = square_document();
  json& primitive = document["meshes"][0]["primitives"][0];
  primitive.erase("indices");
  EXPECT_EQ(read_document(document).triangles, (std::vector<Triangle>{{0, 1, 2}}));
  primitive["mode"] = 5;
  EXPECT_EQ(read_document(document).triangles, (std::vector<Triangle>{{0, 1, 2}, {1, 3, 2}}));
  primitive["mode"] = 6;
  EXPECT_EQ(read_document(document).triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
  primitive["mode"] = 7;
  EXPECT_EQ(problem_of(document), "has a primitive of the unknown mode 7");
}

TEST(Gltf, ReadsPointsAsACloud) {
  json document = square_document();
  document["meshes"][0]["primitives"][0]["mode"] = 0;
  EXPECT_EQ(test::read_cloud("a.gltf", document.dump()).points, kSquareVertices);
  document["meshes"][0]["primitives"][0]["mode"] = 1;  // lines
  EXPECT_EQ(problem_of(document), "holds neither a face nor a point");
}

TEST(Gltf, ReadsIndicesOfEverySize) {
  for (const int type : {5121, 5123, 5125}) {
    std::string bytes = square_buffer().substr(0, 48);
    for (const Triangle& triangle : kSquareTriangles) {
      for (const std::uint32_t i : triangle) {
        bytes += type == 5121 ? little(std::uint8_t(i)) : type == 5123 ? little(std::uint16_t(i)) : little(i);
      }
    }
    json document = square_document("data:application/octet-stream;base64," + base64(bytes));
    document["buffers"][0]["byteLength"] = bytes.size();
    document["bufferViews"][1]["byteLength"] = bytes.size() - 48;
    document["accessors"][1]["componentType"] = type;
    expect_square(read_document(document));
  }
}

TEST(Gltf, ReadsStridedAndQuantizedVertices) {
  const std::string vertices("\0\0\0.\x7f\0\0.\x7f\x7f\0.\0\x7f\0.", 16);
  json document = square_document("data:application/octet-stream;base64," + base64(vertices));
  document["extensionsRequired"] = {"KHR_mesh_quantization"};
  document["buffers"][0]["byteLength"] = 16;
  document["bufferViews"] = {{{"buffer", 0}, {"byteLength", 16}, {"byteStride", 4}}};
  document["accessors"] = {
      {{"bufferView", 0}, {"componentType", 5120}, {"normalized", true}, {"count", 4}, {"type", "VEC3"}}};
  document["meshes"][0]["primitives"][0] = {{"attributes", {{"POSITION", 0}}}, {"mode", 6}};
  expect_square(read_document(document));
}

TEST(Gltf, ChecksEveryAccessor) {
  const auto broken = [](const char* list, int index, const char* key, const json& value) {
    json document = square_document();
    document[list][static_cast<std::size_t>(index)][key] = value;
    return problem_of(document);
  };
  EXPECT_EQ(broken("accessors", 0, "count", 5), "its accessor 0 reaches beyond its bufferView");
  EXPECT_EQ(broken("accessors", 0, "byteOffset", 4), "its accessor 0 reaches beyond its bufferView");
  EXPECT_EQ(broken("accessors", 0, "byteOffset", 18446744073709551612U),
            "its accessor 0 reaches beyond its bufferView");
  EXPECT_EQ(broken("accessors", 0, "count", 6148914691236517206U), "its accessor 0 reaches beyond its bufferView");
  EXPECT_EQ(broken("accessors", 1, "count", 7), "its accessor 1 reaches beyond its bufferView");
  EXPECT_EQ(broken("accessors", 1, "type", "VEC2"), "its accessor 1 holds values of the wrong kind");
  EXPECT_EQ(broken("accessors", 1, "componentType", 5126), "its accessor 1 reaches beyond its bufferView");
  EXPECT_EQ(broken("accessors", 0, "componentType", 5124), "its accessor 0 has the unknown componentType 5124");
  EXPECT_EQ(broken("accessors", 0, "bufferView", 9), "its bufferView 9 does not exist (2 do)");
  EXPECT_EQ(broken("bufferViews", 0, "byteLength", 61), "its bufferView 0 reaches beyond its buffer");
  EXPECT_EQ(broken("bufferViews", 0, "byteOffset", 13), "its bufferView 0 reaches beyond its buffer");
  EXPECT_EQ(broken("bufferViews", 0, "byteStride", 4), "its accessor 0 has values that overlap");
  EXPECT_EQ(broken("bufferViews", 0, "buffer", -1), "its buffer -1 does not exist (1 do)");
  EXPECT_EQ(broken("meshes", 0, "primitives", {{{"attributes", {{"POSITION", 7}}}}}),
            "its accessor 7 does not exist (2 do)");
  EXPECT_EQ(broken("nodes", 0, "mesh", 3), "its mesh 3 does not exist (1 do)");
  EXPECT_EQ(broken("scenes", 0, "nodes", {3}), "its node 3 does not exist (1 do)");
  json document = square_document();
  document["accessors"][0].erase("bufferView");
  EXPECT_EQ(problem_of(document), "its accessor 0 has no data in the file (it may be compressed)");
}

TEST(Gltf, ChecksIndicesAndCoordinates) {
  std::string bytes = square_buffer();
  bytes.replace(58, 2, little(std::uint16_t{4}));
  EXPECT_EQ(problem_of(square_document("data:application/octet-stream;base64," + base64(bytes))),
            "its accessor 1 holds the vertex index 4, which is out of range (4 vertices)");
  bytes.replace(12, 4, little(std::uint32_t{0x7F800000}));
  EXPECT_EQ(problem_of(square_document("data:application/octet-stream;base64," + base64(bytes))),
            "its accessor 0 holds the vertex 1, which is not finite");
}

TEST(Gltf, EndsCircles) {
  json document = square_document();
  document["nodes"] = {{{"children", {1}}}, {{"children", {0}}}};
  EXPECT_EQ(problem_of(document), "its node 0 is below two nodes or below itself");
  document["nodes"] = {{{"children", {1, 1}}}, {{"mesh", 0}}};
  EXPECT_EQ(problem_of(document), "its node 1 is below two nodes or below itself");
}

TEST(Gltf, WalksLongChainsOfNodes) {
  json document = square_document();
  constexpr int length = 30'000;
  document["nodes"] = json::array();
  for (int i = 0; i + 1 < length; ++i) {
    document["nodes"].push_back({{"children", {i + 1}}, {"translation", {1, 0, 0}}});
  }
  document["nodes"].push_back({{"mesh", 0}});
  const Mesh mesh = std::get<Mesh>(test::read_bytes("a.gltf", document.dump(), {.max_growth = 100}));
  EXPECT_EQ(mesh.vertices[0], Vec3(length - 1, 0, 0));
}

TEST(Gltf, RefusesInWords) {
  EXPECT_EQ(problem_with("a.gltf", ""), "is empty");
  EXPECT_EQ(problem_with("a.gltf", "OFF\n"), "is no valid JSON at byte 1");
  EXPECT_EQ(problem_with("a.gltf", "[1]"), "is no glTF file: its JSON is not an object");
  EXPECT_EQ(problem_with("a.gltf", R"({"asset": {"version": "2.0"}, "nodes": [{"scale": [1e999]}]})"),
            "holds JSON that cannot be read");
  EXPECT_EQ(problem_with("a.gltf", std::string(100'000, '[')), "its JSON is nested more than 64 levels deep");
  EXPECT_EQ(problem_with("a.gltf", R"({"asset": {"version": "2.0"}})"), "holds neither a face nor a point");
  EXPECT_TRUE(problem_with("a.gltf", "{}").starts_with("is no valid glTF file: "));
  json document = square_document();
  document["extensionsRequired"] = {"KHR_materials_unlit", "ACME_secret_shape"};
  EXPECT_EQ(problem_of(document), "needs the glTF extension 'ACME_secret_shape', which spincat does not read");
  document = square_document();
  document["buffers"][0]["byteLength"] = 61;
  EXPECT_EQ(problem_of(document), "its buffer 0 is cut off: 60 of 61 bytes");
}

TEST(Gltf, NamesOtherVersions) {
  json document = square_document();
  for (const json& version : {json("1.0"), json("1.1"), json("1"), json(1), json(1.0)}) {
    document["asset"]["version"] = version;
    EXPECT_EQ(problem_of(document), "is a glTF file of version 1; spincat reads version 2") << version;
  }
  document["asset"]["version"] = "3.0";
  EXPECT_EQ(problem_of(document), "is a glTF file of version 3; spincat reads version 2");
  document["asset"]["version"] = "2.1";
  expect_square(read_document(document));
  EXPECT_EQ(problem_with("a.gltf", R"({"meshes": {"m": {"primitives": []}}, "scene": "s"})"),
            "is a glTF file of version 1; spincat reads version 2");
}

TEST(Gltf, NeedsNoExtensionThatSaysNothingOfShape) {
  json document = square_document();
  for (const char* name : {"KHR_materials_unlit",
                           "KHR_materials_variants",
                           "KHR_texture_transform",
                           "KHR_texture_basisu",
                           "EXT_texture_webp",
                           "EXT_texture_avif",
                           "MSFT_texture_dds",
                           "KHR_lights_punctual",
                           "EXT_lights_image_based",
                           "KHR_techniques_webgl",
                           "KHR_animation_pointer",
                           "KHR_xmp_json_ld",
                           "KHR_audio_emitter",
                           "KHR_physics_rigid_bodies",
                           "KHR_interactivity",
                           "EXT_mesh_features",
                           "EXT_structural_metadata",
                           "VRMC_vrm",
                           "MSFT_lod",
                           "CESIUM_primitive_outline",
                           "KHR_mesh_quantization",
                           "KHR_node_visibility"}) {
    document["extensionsRequired"] = {name};
    document["extensionsUsed"] = {name};
    document["meshes"][0]["extensions"][name] = {{"what", {"ever"}}};
    expect_square(read_document(document));
  }
}

TEST(Gltf, ReadsBuffersInTheTextOfAnyType) {
  const std::string bytes = base64(square_buffer());
  for (const std::string start : {"data:;base64,", "data:application/gltf-buffer;base64,", "DATA:;BASE64,",
                                  "data:image/png;charset=utf-8;base64,", "data:x;base64,"}) {
    expect_square(read_document(square_document(start + bytes)));
  }
  expect_square(read_document(square_document("data:;base64," + bytes.substr(0, 20) + "\n" + bytes.substr(20))));
  std::string coded = "data:,";
  for (const char c : square_buffer()) {
    coded += fmt::format("%{:02x}", static_cast<unsigned char>(c));
  }
  expect_square(read_document(square_document(coded)));
  EXPECT_EQ(problem_of(square_document("data:;base64")), "its buffer 0 has no ',' after 'data:'");
  EXPECT_EQ(problem_of(square_document("data:;base64,****" + bytes)), "its buffer 0 holds no valid base64");
  EXPECT_EQ(problem_of(square_document("data:;base64," + bytes.substr(0, 40))),
            "its buffer 0 is cut off: 30 of 60 bytes");
}

TEST(Gltf, ReadsNumbersOf64Bits) {
  std::string bytes;
  for (const Vec3& vertex : kSquareVertices) {
    bytes += little_row<double>(vertex.x(), vertex.y(), vertex.z());
  }
  json document = square_document();
  document["extensionsRequired"] = {"KHR_accessor_float64"};
  document["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = add_accessor(document, bytes, 5130, "VEC3", 4);
  expect_square(read_document(document));
}

TEST(Gltf, RefusesDamagedBinaryFiles) {
  const std::string good = glb(square_document("").dump(), square_buffer());
  EXPECT_EQ(problem_with("a.glb", good.substr(0, 11)), "is cut off within its header");
  EXPECT_EQ(problem_with("a.glb", good.substr(0, good.size() - 1)),
            fmt::format("is cut off: {} of {} bytes", good.size() - 1, good.size()));
  std::string bad = good;
  bad[4] = '\1';
  EXPECT_EQ(problem_with("a.glb", bad), "is a GLB file of version 1; spincat reads version 2");
  json document = square_document("");
  document["buffers"][0]["byteLength"] = 64;
  EXPECT_EQ(problem_with("a.glb", glb(document.dump(), square_buffer())), "its buffer 0 is cut off: 60 of 64 bytes");
  EXPECT_EQ(problem_with("a.gltf", document.dump()), "its buffer 0 is cut off: 0 of 64 bytes");
}

TEST(Gltf, RefusesMillionsOfEmptyNodes) {
  for (const std::string node : {"{}", "{\"mesh\":0}"}) {
    std::string text = R"({"asset":{"version":"2.0"},"nodes":[{})";
    for (int i = 0; i < 500'000; ++i) {
      text += "," + node;
    }
    const std::string problem = problem_with("a.gltf", text + "]}");
    EXPECT_TRUE(problem.starts_with("would take ") && problem.ends_with("--max-growth raises this limit")) << problem;
  }
}

TEST(Gltf, KeepsToTheLimits) {
  EXPECT_EQ(problem_with("a.gltf", square_document().dump(), {.max_points = 3}),
            "holds more than 3 points; --max-points raises this limit");
  EXPECT_EQ(problem_with("a.gltf", square_document().dump(), {.max_triangles = 1}),
            "holds more than 1 triangles; --max-triangles raises this limit");
}

// A scene may show a mesh many times over, and does so in a few bytes each.
TEST(Gltf, RepeatsAMeshOnlyAsFarAsItsSizeAllows) {
  json document = square_document();
  std::string vertices;
  for (int i = 0; i < 36'000; ++i) {
    vertices += little(static_cast<float>(i));
  }
  const std::string bytes = vertices + square_buffer().substr(48);
  document["buffers"][0] = {{"byteLength", bytes.size()},
                            {"uri", "data:application/octet-stream;base64," + base64(bytes)}};
  document["bufferViews"] = {{{"buffer", 0}, {"byteLength", vertices.size()}},
                             {{"buffer", 0}, {"byteOffset", vertices.size()}, {"byteLength", 12}}};
  document["accessors"][0]["count"] = 12'000;
  for (int i = 1; i < 20; ++i) {
    document["nodes"].push_back({{"mesh", 0}}), document["scenes"][0]["nodes"].push_back(i);
  }
  EXPECT_EQ(problem_with("a.gltf", document.dump()), "(nothing thrown)");
  for (int i = 20; i < 100; ++i) {
    document["nodes"].push_back({{"mesh", 0}}), document["scenes"][0]["nodes"].push_back(i);
  }
  const std::string problem = problem_with("a.gltf", document.dump());
  EXPECT_TRUE(problem.starts_with("would take ") && problem.ends_with("--max-growth raises this limit")) << problem;
  EXPECT_EQ(problem_with("a.gltf", document.dump(), {.max_growth = 1'000}), "(nothing thrown)");
}

// Nodes and primitives of a few bytes each, whose number is multiplied.
TEST(Gltf, LooksAtPrimitivesOfNothingOnlyAsOftenAsItsSizeAllows) {
  json document = square_document();
  constexpr int many = 2'000;
  const json lines = {{"attributes", {{"POSITION", 0}}}, {"mode", 1}};
  const json none = {{"attributes", json::object()}};
  for (const json& nothing : {lines, none}) {
    document["meshes"][0]["primitives"] = json::array();
    document["nodes"] = json::array();
    document["scenes"][0]["nodes"] = json::array();
    for (int i = 0; i < many; ++i) {
      document["meshes"][0]["primitives"].push_back(nothing);
      document["nodes"].push_back({{"mesh", 0}});
      document["scenes"][0]["nodes"].push_back(i);
    }
    const std::string problem = problem_with("a.gltf", document.dump());
    EXPECT_TRUE(problem.starts_with("would take ") && problem.ends_with("--max-growth raises this limit")) << problem;
    EXPECT_EQ(problem_with("a.gltf", document.dump(), {.max_growth = 5'000}), "holds neither a face nor a point");
  }
}

// Each buffer takes its bytes, whatever file they come from.
TEST(Gltf, CountsAFileThatManyBuffersNameOnce) {
  const test::TempDir dir;
  constexpr std::size_t size = 1'000'000;
  dir.write("a.bin", square_buffer() + std::string(size, '\0'));
  std::filesystem::create_hard_link(dir / "a.bin", dir / "b.bin");
  std::filesystem::create_symlink("a.bin", dir / "c.bin");
  const auto problem_with_buffers = [&](int count, const ReadLimits& limits = {}) {
    json document = square_document("a.bin");
    document["buffers"] = json::array();
    for (int i = 0; i < count; ++i) {
      document["buffers"].push_back({{"byteLength", size}, {"uri", std::string(1, "abc"[i % 3]) + ".bin"}});
    }
    const std::filesystem::path file = dir.write("a.gltf", document.dump());
    return test::input_error([&] { read_object(file, limits); });
  };
  EXPECT_EQ(problem_with_buffers(30), "no error");
  const std::string problem = problem_with_buffers(45);  // more than 20 times 1 MB and 16 MB
  EXPECT_TRUE(problem.find(": would take 46") != std::string::npos && problem.ends_with("raises this limit"))
      << problem;
  EXPECT_EQ(problem_with_buffers(45, {.max_growth = 40}), "no error");
}

TEST(Gltf, ReadsNoMoreOfAFileThanItsBufferHas) {
  const test::TempDir dir;
  std::filesystem::resize_file(dir.write("a.bin", square_buffer()), std::uintmax_t{1} << 40);  // a terabyte of nothing
  expect_square(std::get<Mesh>(read_object(dir.write("a.gltf", square_document("a.bin").dump()))));
}

// What a repeated mesh comes to is weighed against what is read, not against the size of a file beside.
TEST(Gltf, DoesNotCountWhatItDoesNotRead) {
  const test::TempDir dir;
  std::filesystem::resize_file(dir.write("a.bin", ""), 10'000'000);
  json document = square_document("a.bin");
  document["buffers"][0]["byteLength"] = 240'000;
  document["bufferViews"] = {{{"buffer", 0}, {"byteLength", 240'000}}, {{"buffer", 0}, {"byteLength", 12}}};
  document["accessors"][0]["count"] = 20'000;
  for (int i = 1; i < 40; ++i) {
    document["nodes"].push_back({{"mesh", 0}}), document["scenes"][0]["nodes"].push_back(i);
  }
  const std::string problem = test::input_error([&] { read_object(dir.write("a.gltf", document.dump())); });
  EXPECT_NE(problem.find("would take "), std::string::npos) << problem;
}

TEST(Gltf, SaysWhatIsWrongWithAFileBeside) {
  const test::TempDir dir;
  dir.write("a.bin", square_buffer().substr(1));
  std::filesystem::create_symlink("loop.bin", dir / "loop.bin");
  std::filesystem::create_symlink("/dev/zero", dir / "zero.bin");
  const auto problem_with_file = [&](const std::string& uri) {
    const std::filesystem::path file = dir.write("a.gltf", square_document(uri).dump());
    return test::input_error([&] { read_object(file); }).substr(file.string().size() + 2);
  };
  EXPECT_EQ(problem_with_file("a.bin"), "its buffer 0 is cut off: 59 of 60 bytes");
  EXPECT_EQ(problem_with_file("loop.bin"), "its buffer 'loop.bin': too many levels of symbolic links");
  EXPECT_EQ(problem_with_file("zero.bin"), "its buffer 'zero.bin' is no regular file");
  EXPECT_EQ(problem_with_file(std::string(300, 'a')), "its buffer 'aaaaaaaaaaaaaaaaaaaaaaaa...': file name too long");
}

TEST(Gltf, SurvivesDamage) {
  test::expect_survives_damage("a.gltf", square_document().dump());
  test::expect_survives_damage("a.glb", glb(square_document("").dump(), square_buffer()));
}

}  // namespace
}  // namespace spincat
