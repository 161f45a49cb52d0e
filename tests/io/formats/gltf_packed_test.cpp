// glTF files whose vertices and corners are compressed, by Draco or by meshoptimizer.
#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "io/formats/gltf_square.h"
#include "spincat/io/formats/data_uri.h"
#include "spincat/io/formats/draco_mesh.h"

namespace spincat {
namespace {

using namespace test;
using nlohmann::json;

// A box of 2 x 1 x 0.5, as draco_encoder writes it: with -cl 7, -cl 0 (one face behind the other), -qp 0 (numbers as
// they are), with metadata, and as a cloud.
constexpr const char* kEdgebreaker =
    "RFJBQ08CAgEBAAAACAwACwAAA1+rCgEBEAH/AAABAAkDAAACAQEBAAwDAQgBCBsBCAEoBACcjIUAAAAAA/B/AAgA6P//APB/AAAA"
    "AP4HwP8BAAAAAAD/BwAAAAAAAAAAAAAAAAAAAAAAQAs=";
constexpr const char* kSequential =
    "RFJBQ08CAgEAAAAMCAEAAQIAAgMEBQYEBgcAAwUABQQDAgYDBgUCAQcCBwYBAAQBBAcBAQAJAwAAAgABAQAMAwEYAQgfASAEAFgl"
    "ggDA/wEQAPwfAAIAAAADgP8DQAAAAAAA/wcAAAAAAAAAAAAAAAAAAAAAAEAL";
constexpr const char* kExact =
    "RFJBQ08CAgEBAAAACAwACwAAA1+rCgEBEAH/AAABAAkDAAAAAAAAAAAAAAAAAAA/AAAAQAAAgD8AAAA/AAAAAAAAgD8AAAA/AAAA"
    "QAAAgD8AAAAAAAAAQAAAAAAAAAAAAAAAQAAAAAAAAAA/AAAAAAAAAAAAAAAAAAAAAAAAgD8AAAAA";
constexpr const char* kWithMetadata =
    "RFJBQ08CAgEBAIABAQIDYm94BAAAAAAEbmFtZQdzdWJfb2JqAAAAAAgMAQsAAANfqwoBARD/AjVBAv8AAAAAAAEACQMAAAIBBAIB"
    "AAEBAQEBAAwDAQgBCBsBCAEoBACcjIUAAAAAA/B/AAgA6P//APB/AAAAAP4HwP8BAAAAAAD/BwAAAAAAAAAAAAAAAAAAAAAAQAsB"
    "AQEBAQEBQAEAAAAAAAAAAAA=";
constexpr const char* kCloud =
    "RFJBQ08CAwABAAAIAAAAAQEACQMAAAYLAAAACAAAAP8BM/8BM/8BEQEBAAEBAAEBAAEBAAEBAAEBAAEBAAEBAAEBAAEBAAEBAAEB"
    "AAEBAAEBAAEBAAEBAAEBAAEBAAEBAAEBAAEBAAEBAAEBAAEBAAEBAAEBAAEBAAEBAAEBAAEBACAAAAAA+B9AAPA/AALgfwAEwP8A"
    "AAAAAAAAAAAgAAAAAAAAAAQAAAAAAAAABAAAAAAAAAAAAAAAAAAAAAAAAAAAAABACw==";

std::string bytes_of(const char* coded) {
  return io::decode_data_uri(std::string("data:;base64,") + coded);
}

json draco_document(const std::string& bytes) {
  json document = square_document();
  const std::size_t view = add_view(document, bytes);
  document["accessors"] = {{{"componentType", 5126}, {"count", 8}, {"type", "VEC3"}},
                           {{"componentType", 5125}, {"count", 36}, {"type", "SCALAR"}}};
  document["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"] = {
      {"bufferView", view}, {"attributes", {{"POSITION", 0}}}};
  document["extensionsRequired"] = {"KHR_draco_mesh_compression"};
  return document;
}

json draco_document(const char* coded) {
  return draco_document(bytes_of(coded));
}

void expect_box(const Mesh& mesh) {
  ASSERT_EQ(mesh.vertices.size(), 8U);
  EXPECT_EQ(mesh.triangles.size(), 12U);
  for (const double x : {0.0, 2.0}) {
    for (const double y : {0.0, 1.0}) {
      for (const double z : {0.0, 0.5}) {
        EXPECT_TRUE(
            std::ranges::any_of(mesh.vertices, [&](const Vec3& at) { return (at - Vec3(x, y, z)).norm() < 1e-3; }))
            << x << ' ' << y << ' ' << z;
      }
    }
  }
  double volume = 0;
  for (const Triangle& triangle : mesh.triangles) {
    volume += mesh.vertices[triangle[0]].dot(mesh.vertices[triangle[1]].cross(mesh.vertices[triangle[2]])) / 6;
  }
  EXPECT_NEAR(std::abs(volume), 1, 1e-2);
}

class GltfDraco : public testing::Test {
 protected:
  void SetUp() override {
    if (!io::has_draco()) {
      GTEST_SKIP() << "built without Draco";
    }
  }
};

TEST_F(GltfDraco, ReadsBothEncodings) {
  for (const char* coded : {kEdgebreaker, kSequential, kExact}) {
    expect_box(read_document(draco_document(coded)));
  }
  expect_box(read_document(draco_document(kWithMetadata)));
}

TEST_F(GltfDraco, PlacesWhatItReads) {
  json document = draco_document(kExact);
  document["nodes"][0]["scale"] = {2, 2, 2};
  document["nodes"][0]["translation"] = {10, 0, 0};
  const Mesh mesh = read_document(document);
  EXPECT_EQ(std::ranges::max(mesh.vertices, {}, [](const Vec3& at) { return at.x(); }).x(), 14);
}

TEST_F(GltfDraco, MakesTrianglesOfStrips) {
  json document = draco_document(kExact);
  document["meshes"][0]["primitives"][0]["mode"] = 5;
  expect_box(read_document(document));
}

TEST_F(GltfDraco, IsReadWhereItIsNotRequired) {
  json document = draco_document(kEdgebreaker);
  document.erase("extensionsRequired");
  document["extensionsUsed"] = {"KHR_draco_mesh_compression"};
  expect_box(read_document(document));
}

TEST_F(GltfDraco, SharesNoVerticesBetweenPrimitives) {
  json document = draco_document(kExact);
  document["meshes"][0]["primitives"].push_back(document["meshes"][0]["primitives"][0]);
  EXPECT_EQ(read_document(document).vertices.size(), 16U);
}

TEST_F(GltfDraco, SaysWhatIsWrong) {
  const std::string good = bytes_of(kEdgebreaker);
  EXPECT_EQ(problem_of(draco_document(good.substr(0, good.size() / 2))), "holds a Draco mesh that is damaged");
  EXPECT_EQ(problem_of(draco_document(good.substr(0, 10))), "holds no Draco mesh");
  EXPECT_EQ(problem_of(draco_document("BEERE" + good.substr(5))), "holds no Draco mesh");
  EXPECT_EQ(problem_of(draco_document(kCloud)), "holds a Draco mesh of version 2.3; spincat reads 2.2");
  std::string old = good;
  old[5] = 1;
  EXPECT_EQ(problem_of(draco_document(old)), "holds a Draco mesh of version 1.2; spincat reads 2.2");
  std::string cloud = good;
  cloud[7] = 0;
  EXPECT_EQ(problem_of(draco_document(cloud)), "holds something of Draco that is no mesh");
  json document = draco_document(kEdgebreaker);
  json& draco = document["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"];
  draco["attributes"] = {{"POSITION", 7}};
  EXPECT_EQ(problem_of(document), "holds a Draco mesh without the attribute 7 ('POSITION')");
  draco["attributes"] = {{"NORMAL", 0}};
  EXPECT_EQ(problem_of(document), "holds a Draco mesh without positions");
  draco["bufferView"] = 9;
  EXPECT_EQ(problem_of(document), "its bufferView 9 does not exist or reaches beyond its buffer");
}

// What the first bytes announce is taken only where the file is large enough.
TEST_F(GltfDraco, BoundsWhatIsAnnounced) {
  const std::string billions("\xFF\xFF\xFF\xFF\x04", 5);
  const std::string edge = bytes_of(kEdgebreaker), sequential = bytes_of(kSequential);
  // The numbers of faces and of points begin behind the header of 11 bytes (and the kind of traversal).
  const std::vector<std::string> bad = {edge.substr(0, 12) + billions + edge.substr(13),  // vertices
                                        edge.substr(0, 13) + billions + edge.substr(14),  // faces
                                        sequential.substr(0, 11) + billions + sequential.substr(12),
                                        sequential.substr(0, 12) + billions + sequential.substr(13)};
  for (const std::string& bytes : bad) {
    const std::string problem = problem_of(draco_document(bytes));
    EXPECT_TRUE(problem.starts_with("would take ") && problem.ends_with("--max-growth raises this limit")) << problem;
  }
}

TEST_F(GltfDraco, SurvivesDamage) {
  for (const char* coded : {kEdgebreaker, kSequential, kWithMetadata}) {
    const std::string good = bytes_of(coded);
    const TempDir dir;
    for (std::size_t at = 0; at < good.size(); ++at) {
      for (const char byte : {'\0', '\xff', '9', static_cast<char>(good[at] ^ 1)}) {
        std::string bad = good;
        bad[at] = byte;
        expect_sound_or_refused(dir, "a.gltf", draco_document(bad).dump());
      }
    }
  }
}

// For those who know no Draco: read where spincat was built without it, and preferred, as it is exact.
TEST(GltfWithoutDraco, ReadsTheDataBeside) {
  json document = square_document();
  const std::size_t view = add_view(document, "none of Draco's");
  document["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"] = {
      {"bufferView", view}, {"attributes", {{"POSITION", 0}}}};
  document["extensionsUsed"] = {"KHR_draco_mesh_compression"};
  expect_square(read_document(document));
}

TEST(GltfWithoutDraco, SaysThatItIsMissing) {
  if (io::has_draco()) {
    GTEST_SKIP() << "built with Draco";
  }
  EXPECT_EQ(problem_of(draco_document(kEdgebreaker)),
            "is compressed with Draco, which this spincat was built without (scripts/setup installs it)");
}

template <class Encode>
std::string encoded(std::size_t bound, Encode encode) {
  std::vector<unsigned char> bytes(bound);
  bytes.resize(encode(bytes.data(), bytes.size()));
  return {bytes.begin(), bytes.end()};
}

std::string pack_vertices(const std::string& vertices, std::size_t stride) {
  const std::size_t count = vertices.size() / stride;
  return encoded(meshopt_encodeVertexBufferBound(count, stride), [&](unsigned char* out, std::size_t size) {
    return meshopt_encodeVertexBuffer(out, size, vertices.data(), count, stride);
  });
}

std::string pack_triangles(const std::vector<unsigned>& corners) {
  return encoded(meshopt_encodeIndexBufferBound(corners.size(), 4), [&](unsigned char* out, std::size_t size) {
    return meshopt_encodeIndexBuffer(out, size, corners.data(), corners.size());
  });
}

std::string pack_indices(const std::vector<unsigned>& corners) {
  return encoded(meshopt_encodeIndexSequenceBound(corners.size(), 4), [&](unsigned char* out, std::size_t size) {
    return meshopt_encodeIndexSequence(out, size, corners.data(), corners.size());
  });
}

// The square with both of its bufferViews packed; the buffer that they are unpacked into is nowhere.
json meshopt_document(const char* extension = "EXT_meshopt_compression") {
  json document = square_document();
  const std::size_t vertices = add_buffer(document, pack_vertices(square_buffer().substr(0, 48), 12));
  const std::size_t corners = add_buffer(document, pack_triangles({0, 1, 2, 0, 2, 3}));
  document["buffers"][0] = {{"byteLength", 60}, {"extensions", {{extension, {{"fallback", true}}}}}};
  document["bufferViews"][0]["byteStride"] = 12;
  const auto packed = [&](std::size_t buffer, int count, int stride, const char* mode) {
    return json{{"buffer", buffer},
                {"byteLength", document["buffers"][buffer]["byteLength"]},
                {"count", count},
                {"byteStride", stride},
                {"mode", mode}};
  };
  document["bufferViews"][0]["extensions"][extension] = packed(vertices, 4, 12, "ATTRIBUTES");
  document["bufferViews"][1]["extensions"][extension] = packed(corners, 6, 2, "TRIANGLES");
  document["extensionsRequired"] = {extension};
  return document;
}

json& first_packed(json& document) {
  return document["bufferViews"][0]["extensions"]["EXT_meshopt_compression"];
}

void expect_square_turned(const Mesh& mesh) {  // packing may begin a triangle at another corner
  EXPECT_EQ(mesh.vertices, kSquareVertices);
  ASSERT_EQ(mesh.triangles.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    Triangle triangle = mesh.triangles[i];
    std::ranges::rotate(triangle, std::ranges::min_element(triangle));
    EXPECT_EQ(triangle, kSquareTriangles[i]);
  }
}

TEST(GltfMeshopt, ReadsVerticesAndTriangles) {
  expect_square_turned(read_document(meshopt_document()));
  expect_square_turned(read_document(meshopt_document("KHR_meshopt_compression")));
}

TEST(GltfMeshopt, NeedsNoBufferToUnpackInto) {
  json document = meshopt_document();
  document["buffers"][0].erase("extensions");
  expect_square_turned(read_document(document));
  document["buffers"][0]["uri"] = "missing.bin";
  EXPECT_EQ(problem_of(document), "its buffer 'missing.bin': no such file");
  document["buffers"][0]["extensions"]["EXT_meshopt_compression"]["fallback"] = true;
  expect_square_turned(read_document(document));
}

TEST(GltfMeshopt, ReadsBinaryFiles) {
  json document = meshopt_document();
  const std::string vertices = pack_vertices(square_buffer().substr(0, 48), 12);
  document["buffers"][1] = document["buffers"][0];
  document["buffers"][0] = {{"byteLength", vertices.size()}};
  document["bufferViews"][0]["buffer"] = 1;
  document["bufferViews"][1]["buffer"] = 1;
  first_packed(document)["buffer"] = 0;
  expect_square_turned(read_mesh("a.glb", glb(document.dump(), vertices)));
}

TEST(GltfMeshopt, ReadsIndicesOfEitherSize) {
  json document = meshopt_document();
  const std::string packed = pack_indices({0, 1, 2, 0, 2, 3});
  json& view = document["bufferViews"][1]["extensions"]["EXT_meshopt_compression"];
  view.update({{"buffer", add_buffer(document, packed)}, {"byteLength", packed.size()}, {"mode", "INDICES"}});
  expect_square(read_document(document));
  view["byteStride"] = 4;
  document["buffers"][0]["byteLength"] = 72;
  document["bufferViews"][1]["byteLength"] = 24;
  document["accessors"][1]["componentType"] = 5125;
  expect_square(read_document(document));
}

TEST(GltfMeshopt, AppliesTheFilterOfExponents) {
  std::vector<float> numbers;
  for (const Vec3& vertex : kSquareVertices) {
    numbers.insert(numbers.end(), {static_cast<float>(vertex.x()), static_cast<float>(vertex.y()), 0});
  }
  std::string filtered(48, '\0');
  meshopt_encodeFilterExp(filtered.data(), 4, 12, 15, numbers.data());
  const std::string packed = pack_vertices(filtered, 12);
  json document = meshopt_document();
  first_packed(document).update(
      {{"buffer", add_buffer(document, packed)}, {"byteLength", packed.size()}, {"filter", "EXPONENTIAL"}});
  expect_square_turned(read_document(document));
}

// A rotation of instances, in eight bytes each: no turn, and half a turn around z.
TEST(GltfMeshopt, AppliesTheFilterOfQuaternions) {
  const std::array<float, 8> turns = {0, 0, 0, 1, 0, 0, 1, 0};
  std::string filtered(16, '\0');
  meshopt_encodeFilterQuat(filtered.data(), 2, 8, 16, turns.data());
  const std::string packed = pack_vertices(filtered, 8);
  json document = square_document();
  const std::size_t buffer = add_buffer(document, packed);
  document["buffers"].push_back({{"byteLength", 16}});
  document["bufferViews"].push_back({{"buffer", buffer + 1},
                                     {"byteLength", 16},
                                     {"extensions",
                                      {{"EXT_meshopt_compression",
                                        {{"buffer", buffer},
                                         {"byteLength", packed.size()},
                                         {"byteStride", 8},
                                         {"count", 2},
                                         {"mode", "ATTRIBUTES"},
                                         {"filter", "QUATERNION"}}}}}});
  document["accessors"].push_back({{"bufferView", document["bufferViews"].size() - 1},
                                   {"componentType", 5122},
                                   {"normalized", true},
                                   {"count", 2},
                                   {"type", "VEC4"}});
  document["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
      {"ROTATION", document["accessors"].size() - 1}};
  const Mesh mesh = read_document(document);
  ASSERT_EQ(mesh.vertices.size(), 8U);
  EXPECT_LT((mesh.vertices[2] - Vec3(1, 1, 0)).norm(), 1e-3);
  EXPECT_LT((mesh.vertices[6] - Vec3(-1, -1, 0)).norm(), 1e-3);
}

// Directions are no positions, but nothing forbids them: (1, 0, 0), (0, 1, 0), (0, 0, 1) and (-1, 0, 0).
TEST(GltfMeshopt, AppliesTheFilterOfDirections) {
  const std::array<float, 16> directions = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -1, 0, 0, 0};
  std::string filtered(16, '\0');
  meshopt_encodeFilterOct(filtered.data(), 4, 4, 8, directions.data());
  const std::string packed = pack_vertices(filtered, 4);
  json document = meshopt_document();
  document["bufferViews"][0].update({{"byteLength", 16}, {"byteStride", 4}});
  document["accessors"][0].update({{"componentType", 5120}, {"normalized", true}});
  first_packed(document).update({{"buffer", add_buffer(document, packed)},
                                 {"byteLength", packed.size()},
                                 {"byteStride", 4},
                                 {"filter", "OCTAHEDRAL"}});
  expect_near(read_document(document).vertices, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}});
}

TEST(GltfMeshopt, SaysWhatIsWrong) {
  const auto problem = [](const char* key, const json& value) {
    json document = meshopt_document();
    first_packed(document)[key] = value;
    return problem_of(document);
  };
  EXPECT_EQ(problem("count", 5), "its bufferView 0 has no room for 5 times 12 bytes");
  EXPECT_EQ(problem("count", 6148914691236517206U),
            "its bufferView 0 has no room for 6148914691236517206 times 12 bytes");
  EXPECT_EQ(problem("count", 3), "its bufferView 0 is to have 48 bytes, but 3 times 12 are compressed");
  EXPECT_EQ(problem("byteStride", 0), "its bufferView 0 has no room for 4 times 0 bytes");
  EXPECT_EQ(problem("byteStride", 10), "its bufferView 0 is to have 48 bytes, but 4 times 10 are compressed");
  EXPECT_EQ(problem("mode", "CUBES"),
            "its bufferView 0 is compressed in the mode 'CUBES' with 4 times 12 bytes, which does not exist");
  EXPECT_EQ(problem("filter", "SEPIA"),
            "its bufferView 0 has the filter 'SEPIA' for the mode 'ATTRIBUTES' and 12 bytes, which does not exist");
  EXPECT_EQ(problem("buffer", 99), "its bufferView 0 reaches beyond its buffer");
  EXPECT_EQ(problem("byteLength", 10'000), "its bufferView 0 reaches beyond its buffer");
  std::string damaged = pack_vertices(square_buffer().substr(0, 48), 12);
  damaged.pop_back();
  json short_one = meshopt_document();
  first_packed(short_one).update({{"buffer", add_buffer(short_one, damaged)}, {"byteLength", damaged.size()}});
  EXPECT_EQ(problem_of(short_one), "its bufferView 0 holds compressed data that is damaged");
  std::string newer = pack_vertices(square_buffer().substr(0, 48), 12);
  newer[0] = static_cast<char>(0xA1);
  json document = meshopt_document();
  first_packed(document)["buffer"] = add_buffer(document, newer);
  EXPECT_EQ(problem_of(document),
            "its bufferView 0 is compressed by a newer meshoptimizer, which spincat does not read");
}

// Views that unpack the same bytes to the same place, again and again.
TEST(GltfMeshopt, IsBounded) {
  json document = meshopt_document();
  document["buffers"][0]["byteLength"] = 1'000'000'000;
  std::string problem = problem_of(document);
  EXPECT_TRUE(problem.starts_with("would take ") && problem.ends_with("--max-growth raises this limit")) << problem;
  constexpr std::size_t vertices = 40'000;
  const std::string packed = pack_vertices(std::string(12 * vertices, '\0'), 12);
  document = meshopt_document();
  document["buffers"][0]["byteLength"] = 12 * vertices;
  document["bufferViews"][0]["byteLength"] = 12 * vertices;
  first_packed(document).update(
      {{"buffer", add_buffer(document, packed)}, {"byteLength", packed.size()}, {"count", vertices}});
  for (int i = 0; i < 500; ++i) {
    document["bufferViews"].push_back(document["bufferViews"][0]);
  }
  problem = problem_of(document);
  EXPECT_TRUE(problem.starts_with("would take ") && problem.ends_with("--max-growth raises this limit")) << problem;
}

TEST(GltfMeshopt, SurvivesDamage) {
  expect_survives_damage("a.gltf", meshopt_document().dump());
}

}  // namespace
}  // namespace spincat
