#include "fuzz/hard_files.h"

#include <meshoptimizer.h>
#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <ostream>
#include <string_view>

#include "io/zip_bytes.h"
#include "support/png_bytes.h"

namespace spincat::test {
namespace {

using namespace std::string_literals;

// `head`, then `part` again and again, then `tail`, of about so many bytes.
std::string repeated(std::size_t size, std::string_view head, std::string_view part, std::string_view tail = "") {
  std::string text(head);
  text.reserve(size + part.size() + tail.size());
  while (text.size() < size) {
    text += part;
  }
  return text.append(tail);
}

Hard repeats(const std::string& reader, const std::string& name, const std::string& head, const std::string& part,
             const std::string& tail = "") {
  return {reader, name, [=](std::size_t size) { return repeated(size, head, part, tail); }};
}

// The same with the number of parts where `head` and `part` have a '#'; parts are counted from 0.
std::string numbered(std::size_t size, std::string_view head, std::string_view part) {
  std::string body;
  std::size_t count = 0;
  const auto put = [](std::string& text, std::string_view pattern, std::size_t number) {
    for (const char c : pattern) {
      c == '#' ? text += std::to_string(number) : text += c;
    }
  };
  for (; body.size() < size; ++count) {
    put(body, part, count);
  }
  std::string text;
  put(text, head, count);
  return text + body;
}

Hard counts(const std::string& reader, const std::string& name, const std::string& head, const std::string& part) {
  return {reader, name, [=](std::size_t size) { return numbered(size, head, part); }};
}

template <class T>
std::string as_bytes(T value) {
  return {reinterpret_cast<const char*>(&value), sizeof(T)};
}

// Points of three bytes, packed as well as can be: 264 bytes out of 3.
std::string packed_pcd(std::size_t size) {
  const std::string packed = repeated(size, "\2\0\0\0"s, "\xE0\xFF\0"s);
  const std::size_t unpacked = 3 + (packed.size() - 4) / 3 * 264;
  const std::size_t points = unpacked / 3;
  return "FIELDS x y z\nSIZE 1 1 1\nTYPE I I I\nPOINTS " + std::to_string(points) + "\nDATA binary_compressed\n" +
         as_bytes(static_cast<std::uint32_t>(packed.size())) + as_bytes(static_cast<std::uint32_t>(unpacked)) + packed;
}

std::string binary_stl(std::size_t size) {
  std::string triangles;
  float corner = 0;
  while (triangles.size() < size) {
    triangles += std::string(12, '\0');
    for (int i = 0; i < 9; ++i) {
      triangles += as_bytes(corner += 1);
    }
    triangles += "\0\0"s;
  }
  return std::string(80, ' ') + as_bytes(static_cast<std::uint32_t>(triangles.size() / 50)) + triangles;
}

// One polygon whose corners take a byte each.
std::string ply_of_tiny_indices(std::size_t size) {
  return "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty char x\nproperty char y\nproperty char z\n"
         "element face 1\nproperty list uint uchar vertex_indices\nend_header\n"s +
         std::string(9, '\1') + as_bytes(static_cast<std::uint32_t>(size)) + std::string(size, '\2');
}

const std::string kPlyHead = "ply\nformat ascii 1.0\n";
const std::string kPlyVertices = "property float x\nproperty float y\nproperty float z\n";

// One strip of corners that take two bytes each.
std::string strip_ply(std::size_t size) {
  std::string indices;
  std::size_t count = 0;
  for (; indices.size() < size; ++count) {
    indices += " " + std::to_string(count % 3);
  }
  return kPlyHead + "element vertex 3\n" + kPlyVertices +
         "element tristrips 1\nproperty list int int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n" +
         std::to_string(count) + indices + "\n";
}

// A face of the first vertex, and others that are not finite.
std::string unused_ply(std::size_t size) {
  const std::string body = repeated(size, "0 0 0\n", "nan 0 0\n");
  return kPlyHead + "element vertex " + std::to_string(std::ranges::count(body, '\n')) + "\n" + kPlyVertices +
         "element face 1\nproperty list uchar int vertex_index\nend_header\n" + body + "3 0 0 0\n";
}

// Half of the file is a buffer, the other half names it as often as can be: `part` goes `where`.
std::string repeating_gltf(std::size_t size, std::string_view nodes, std::string_view primitives) {
  const std::size_t vertices = size / 2 / 16;
  const std::string count = std::to_string(vertices);
  const std::string length = std::to_string(12 * vertices);
  std::string text = R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":)" + length +
                     R"(,"uri":"data:application/octet-stream;base64,)" + std::string(16 * vertices, 'A') +
                     R"("}],"bufferViews":[{"buffer":0,"byteLength":)" + length +
                     R"(}],"accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":)" + count + "}";
  text += R"(],"meshes":[{"primitives":[{"attributes":{"POSITION":0}})";
  const std::size_t rest = primitives.empty() ? 0 : (size - text.size()) / primitives.size();
  for (std::size_t i = 0; i < rest; ++i) {
    text += primitives;
  }
  text += R"(]}],"nodes":[{"mesh":0})";
  while (!nodes.empty() && text.size() < size) {
    text += nodes;
  }
  return text + "]}";
}

// Nodes each below the one before.
std::string chain_gltf(std::size_t size) {
  std::string text = R"({"asset":{"version":"2.0"},"nodes":[{"children":[1]})";
  for (std::size_t i = 2; text.size() < size; ++i) {
    text += R"(,{"children":[)" + std::to_string(i) + "]}";
  }
  return text + "]}";
}

// Nodes that show a mesh, and its primitives, which add nothing: half of a file may multiply the other half. As many as
// may be kept; the rest is a name.
std::string gltf_of_nothing(std::size_t size) {
  const std::size_t many = size / 200;
  std::string text = R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0})";
  for (std::size_t i = 1; i < many; ++i) {
    text += R"(,{"mesh":0})";
  }
  text += R"(],"meshes":[{"primitives":[{"attributes":{}})";
  for (std::size_t i = 1; i < many; ++i) {
    text += R"(,{"attributes":{}})";
  }
  text += R"(]}],"extras":")";
  return text + std::string(size - std::min(size, text.size()), 'a') + "\"}";
}

// Buffers that name two files beside in turn, which are one (readers.cpp).
std::string gltf_of_buffers(std::size_t size) {
  std::string text = R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0}],"buffers":[{"byteLength":4096,"uri":"a.bin"})";
  const std::size_t many = size / 100;
  for (std::size_t i = 0; i < many; ++i) {
    text += i % 2 == 0 ? R"(,{"byteLength":4096,"uri":"a.bin"})" : R"(,{"byteLength":4096,"uri":"b.bin"})";
  }
  text += R"(],"extras":")";
  return text + std::string(size - std::min(size, text.size()), 'a') + "\"}";
}

// Classes each below the one before, and models in the last: as many of both as may be kept.
std::string cla_of_a_chain(std::size_t size) {
  const std::size_t classes = size / 60;
  const std::size_t models = size / 200;
  std::string text = "PSB 1\n" + std::to_string(classes) + " " + std::to_string(models) + "\nc1 0 0";
  for (std::size_t i = 2; i <= classes; ++i) {
    text += "\nc" + std::to_string(i) + " c" + std::to_string(i - 1) + (i < classes ? " 0" : " ");
  }
  text += std::to_string(models);
  for (std::size_t i = 0; i < models; ++i) {
    text += "\n1";
  }
  return text + std::string(size - std::min(size, text.size()), ' ');
}

std::string cbor_array(std::size_t size, std::string_view item) {
  const auto items = static_cast<std::uint32_t>(size / item.size());
  std::string text = "\x9A" + big_endian(items);
  for (std::uint32_t i = 0; i < items; ++i) {
    text += item;
  }
  return text;
}

// The head that readers.cpp asks for, and records of no result.
std::string short_records(std::size_t size) {
  const auto with_checksum = [](std::string bytes) {
    const auto checksum =
        static_cast<std::uint32_t>(crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
    return bytes + as_bytes(checksum);
  };
  const auto text = [](std::string_view words) {
    return as_bytes(static_cast<std::uint64_t>(words.size())) + std::string(words);
  };
  std::string journal = with_checksum(text("SPINCAT-JOURNAL\x01") + text("settings") + text("data"));
  for (std::uint64_t i = 0; journal.size() < size; ++i) {
    journal += with_checksum(as_bytes(i) + as_bytes(i) + text(""));
  }
  return journal;
}

// Zeros, packed as well as can be, of about `size` packed bytes: a megabyte of them again and again.
std::string packed_zeros(std::size_t size) {
  constexpr std::size_t kEach = 1 << 20;
  std::string zeros(kEach, '\0');
  std::string packed(compressBound(kEach) + 100, '\0');
  z_stream stream{};
  deflateInit(&stream, Z_BEST_COMPRESSION);
  stream.next_in = reinterpret_cast<Bytef*>(zeros.data());
  stream.avail_in = kEach;
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  deflate(&stream, Z_FULL_FLUSH);
  packed.resize(packed.size() - stream.avail_out);
  deflateEnd(&stream);
  constexpr std::size_t kZlibHead = 2;
  return repeated(size, packed.substr(0, kZlibHead), std::string_view(packed).substr(kZlibHead));
}

std::string kinect_png(const std::string& chunks) {
  return png_file(640, 480, 16, 0, chunks);
}

// A picture of one depth, as large as may be read from so many bytes; most of them are of no use.
std::string flat_png(std::size_t size) {
  constexpr std::uint32_t kHeight = 4'000;
  const auto width = static_cast<std::uint32_t>((19 * size + 15'000'000) / 8 / kHeight);
  const std::string pixels((2 * std::size_t{width} + 1) * kHeight, '\0');
  std::string packed(compressBound(pixels.size()), '\0');
  uLongf length = packed.size();
  compress2(reinterpret_cast<Bytef*>(packed.data()), &length, reinterpret_cast<const Bytef*>(pixels.data()),
            pixels.size(), Z_BEST_SPEED);
  packed.resize(length);
  const std::size_t rest = size - std::min(size, packed.size());
  return png_file(width, kHeight, 16, 0, png_chunk("IDAT", packed) + png_chunk("xxXx", std::string(rest, 'x')));
}

std::vector<Hard> recordings() {
  return {
      {"png", "a flat picture", flat_png},
      {"png", "more pixels than there are",
       [](std::size_t size) { return kinect_png(png_chunk("IDAT", packed_zeros(size))); }},
      {"png", "packed texts",
       [](std::size_t size) {
         const std::string text = png_chunk("zTXt", "a\0\0"s + packed_zeros(10'000));
         return kinect_png(repeated(size, "", text));
       }},
      {"png", "a packed profile",
       [](std::size_t size) { return kinect_png(png_chunk("iCCP", "a\0\0"s + packed_zeros(size))); }},
      repeats("frames", "short names", "", "0 a\n"),
      repeats("frames", "names", "", "1305031102.160407 depth/1305031102.160407.png\n"),
      repeats("frames", "comments", "", "#\n"),
      repeats("frames", "a long name", "0 ", "a"),
      repeats("camera", "numbers", "", "fx 1\n"),
      repeats("camera", "a long name", "", "a"),
      repeats("camera", "a long number", "fx ", "1"),
  };
}

const std::string kSweep = "{\"sweep\":1,\"settings\":{\"seed\":1}}\n";

std::vector<Hard> object_files() {
  return {
      counts("off", "one polygon", "OFF 3 1\n0 0 0\n1 0 0\n0 1 0\n#", " 1"),
      counts("off", "vertices", "OFF # 0\n", "0 0 0\n"),
      counts("off", "vertices with normals", "NOFF # 0\n", "0 0 0 0 0 1\n"),
      counts("off", "faces of no corner", "OFF 1 # 0\n0 0 0\n", "0\n"),
      counts("off", "triangles", "OFF 1 # 0\n0 0 0\n", "3 0 0 0\n"),
      counts("off", "vertices on one line", "OFF # 0 0\n", "0 0 0 "),
      counts("off", "unused vertices", "OFF # 0 0\n", "nan 0 0\n"),
      repeats("off", "comments", "OFF", "#\n"),
      repeats("off", "a long word", "", "O"),
      repeats("obj", "one polygon", "v 0 0 0\nf", " 1"),
      repeats("obj", "triangles", "v 0 0 0\n", "f 1 1 1\n"),
      repeats("obj", "vertices", "", "v 0 0 0\n"),
      repeats("obj", "normals", "v 0 0 0\n", "vn 0 0 1\n"),
      repeats("obj", "continued lines", "v 0 0 0\nf 1", "\\\n"),
      repeats("obj", "backslashes", "v 0 0 0\nf 1", "\\ "),
      counts("ply", "elements", kPlyHead, "element e# 0\n"),
      counts("ply", "properties", kPlyHead + "element vertex 1\n", "property char p#\n"),
      repeats("ply", "comments", kPlyHead, "comment\n"),
      counts("ply", "vertices", kPlyHead + "element vertex #\n" + kPlyVertices + "end_header\n", "0 0 0\n"),
      counts("ply", "empty lists",
             kPlyHead + "element vertex 1\n" + kPlyVertices +
                 "element face #\nproperty list uchar int vertex_index\nend_header\n0 0 0\n",
             "0\n"),
      {"ply", "indices of a byte", ply_of_tiny_indices},
      {"ply", "a strip", strip_ply},
      counts("ply", "rows on one line", kPlyHead + "element vertex #\n" + kPlyVertices + "end_header\n", "0 0 0 "),
      {"ply", "vertices that no face uses", unused_ply},
      repeats("stl", "one polygon", "solid\nfacet\nouter loop\n", "vertex 0 0 0\n", "endloop\nendsolid\n"),
      counts("stl", "vertices of their own", "solid\nfacet\nouter loop\n", "vertex 0 0 #\n"),
      repeats("stl", "empty loops", "solid\nfacet\n", "outer\nendloop\n", "endsolid\n"),
      {"stl", "binary", binary_stl},
      repeats("pcd", "fields", "FIELDS x y z", " a", "\nPOINTS 1\nDATA ascii\n0 0 0\n"),
      counts("pcd", "points", "FIELDS x y z\nPOINTS #\nDATA ascii\n", "0 0 0\n"),
      repeats("pcd", "values", "FIELDS x y z\nCOUNT 1 1 1000000\nPOINTS 1\nDATA ascii\n", "0 "),
      {"pcd", "packed points", packed_pcd},
      repeats("xyz", "points", "", "0 0 0\n"),
      repeats("xyz", "points with normals", "", "0 0 0 0 0 1\n"),
      repeats("xyz", "one line", "0 0 0", " 0"),
      repeats("xyz", "separators", "0 0 0\n0", ","),
      repeats("xyz", "decimal commas", "", "0,5 1 2\n"),
      repeats("xyz", "decimal commas in one line", "0,5 1 2", " 0,5"),
      repeats("xyz", "names", "x y z", " nx"),
      repeats("xyz", "comments with names", "", "#x y\n"),
      repeats("xyz", "empty scans", "", "0\n"),
      repeats("any", "rows", "", "0 0 0\n"),
      repeats("any", "a long line", "", "v 0 0 0 "),
      repeats("any", "wide letters", "v\0 \0"s + "0\0 \0"s + "0\0 \0"s, "0\0\n\0"s),
  };
}

// Half of the file is a buffer of zeros, base64; the rest says `text` about it, in which '$' is what `part` repeats.
std::string gltf_with(std::size_t size, std::string_view text, std::string_view part) {
  const std::size_t vertices = size / 2 / 16;
  std::string all = R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":)" + std::to_string(12 * vertices) +
                    R"(,"uri":"data:;base64,)" + std::string(16 * vertices, 'A') +
                    R"("}],"bufferViews":[{"buffer":0,"byteLength":)" + std::to_string(12 * vertices) + "}],";
  for (const char c : text) {
    if (c == '#') {
      all += std::to_string(vertices);
    } else if (c == '$') {
      all = repeated(size, all, part);
    } else {
      all += c;
    }
  }
  return all;
}

Hard gltf_of(const std::string& name, const std::string& text, const std::string& part) {
  return {"gltf", name, [=](std::size_t size) { return gltf_with(size, text, part); }};
}

const std::string kAccessors = R"("accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":#}],)";

// A vertex buffer of meshoptimizer that is all zeros: 16 vertices of 256 bytes in 4 bytes of each of their bytes.
std::string packed_vertices(std::size_t vertices) {
  std::vector<unsigned char> packed(meshopt_encodeVertexBufferBound(vertices, 12));
  const std::string zeros(12 * vertices, '\0');
  packed.resize(meshopt_encodeVertexBuffer(packed.data(), packed.size(), zeros.data(), vertices, 12));
  return {packed.begin(), packed.end()};
}

// As a .glb file of one chunk of text and one of bytes.
std::string glb_of(std::string text, const std::string& bytes) {
  text.resize((text.size() + 3) / 4 * 4, ' ');
  const auto size = [](std::size_t number) { return as_bytes(static_cast<std::uint32_t>(number)); };
  return "glTF" + size(2) + size(28 + text.size() + bytes.size()) + size(text.size()) + "JSON" + text +
         size(bytes.size()) + "BIN\0"s + bytes;
}

// As many vertices as may be unpacked; the rest of the file is of no use.
std::string glb_of_packed_vertices(std::size_t size) {
  const std::size_t vertices = (16'000'000 + 19 * size) / 110;
  const std::string packed = packed_vertices(vertices);
  const std::string length = std::to_string(12 * vertices);
  const std::string text =
      R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],)"
      R"("accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":)" +
      std::to_string(vertices) + R"(}],"buffers":[{"byteLength":)" + std::to_string(std::max(packed.size(), size)) +
      R"(},{"byteLength":)" + length + R"(}],"bufferViews":[{"buffer":1,"byteLength":)" + length +
      R"(,"byteStride":12,"extensions":{"EXT_meshopt_compression":{"buffer":0,"byteLength":)" +
      std::to_string(packed.size()) + R"(,"byteStride":12,"mode":"ATTRIBUTES","count":)" + std::to_string(vertices) +
      "}}}]}";
  std::string bytes = packed;
  bytes.resize(std::max(packed.size(), size));
  return glb_of(text, bytes);
}

std::string seven_bits(std::size_t number) {
  std::string bytes;
  for (; number > 0x7F; number >>= 7) {
    bytes += static_cast<char>((number & 0x7F) | 0x80);
  }
  return bytes + static_cast<char>(number);
}

// A mesh of Draco with as many faces as may be, and points of three numbers of no byte each; the rest is of no use.
std::string glb_of_draco_points(std::size_t size) {
  const std::size_t faces = (16'000'000 + 19 * size) / 600;
  const std::string header = "DRACO\2\2\1\0\0\0"s;
  const std::string corners = "\1" + std::string(3 * faces, '\0');  // not packed
  const std::string position = "\1\1\0\1\3\0\0\1\xFE\0\0"s;         // one attribute, bytes, not packed
  std::string mesh = header + seven_bits(faces) + seven_bits(3 * faces) + corners + position;
  mesh.resize(size);
  return glb_of(R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{},)"
                R"("extensions":{"KHR_draco_mesh_compression":{"bufferView":0,"attributes":{"POSITION":0}}}}]}],)"
                R"("bufferViews":[{"buffer":0,"byteLength":)" +
                    std::to_string(size) + R"(}],"buffers":[{"byteLength":)" + std::to_string(size) + "}]}",
                mesh);
}

std::vector<Hard> gltf_files() {
  return {
      gltf_of("targets of one accessor",
              kAccessors + R"("nodes":[{"mesh":0}],"meshes":[{"weights":[1,1],"primitives":[{"attributes":)"
                           R"({"POSITION":0},"targets":[{"POSITION":0}$]}]}]})",
              R"(,{"POSITION":0})"),
      gltf_of("weights", kAccessors + R"("nodes":[{"mesh":0,"weights":[1$]}],"meshes":[{"primitives":[]}]})", ",1"),
      gltf_of("joints",
              kAccessors + R"("nodes":[{"mesh":0,"skin":0}],"skins":[{"joints":[0$]}],"meshes":[{"primitives":)"
                           R"([{"attributes":{"POSITION":0,"JOINTS_0":0,"WEIGHTS_0":0}}]}]})",
              ",0"),
      gltf_of("skins",
              kAccessors + R"("nodes":[{"mesh":0,"skin":0}],"skins":[{"joints":[0]}$],"meshes":[{"primitives":)"
                           R"([{"attributes":{"POSITION":0,"JOINTS_0":0,"WEIGHTS_0":0}}]}]})",
              R"(,{"joints":[0]})"),
      gltf_of("instances",
              kAccessors + R"("nodes":[{"mesh":0,"extensions":{"EXT_mesh_gpu_instancing":{"attributes":)"
                           R"({"TRANSLATION":0}}}}$],"meshes":[{"primitives":[{"attributes":{}}]}]})",
              R"(,{"extensions":{"EXT_mesh_gpu_instancing":{"attributes":{"SCALE":0}}}})"),
      {"gltf", "packed vertices", glb_of_packed_vertices},
      {"gltf", "points of Draco", glb_of_draco_points},
      {"gltf", "nodes that show one mesh", [](std::size_t size) { return repeating_gltf(size, R"(,{"mesh":0})", ""); }},
      {"gltf", "primitives of one accessor",
       [](std::size_t size) { return repeating_gltf(size, "", R"(,{"attributes":{"POSITION":0}})"); }},
      {"gltf", "one large buffer", [](std::size_t size) { return repeating_gltf(size, "", ""); }},
      {"gltf", "empty nodes", [](std::size_t size) { return repeating_gltf(size, ",{}", ""); }},
      {"gltf", "a chain of nodes", chain_gltf},
      {"gltf", "primitives of nothing", gltf_of_nothing},
      {"gltf", "buffers of one file", gltf_of_buffers},
      repeats("gltf", "children", R"({"asset":{"version":"2.0"},"nodes":[{"children":[0)", ",0", "]}]}"),
      repeats("gltf", "numbers of no use", R"({"asset":{"version":"2.0"},"extras":[0)", ",0", "]}"),
      repeats("gltf", "lists of no use", R"({"asset":{"version":"2.0"},"extras":[0)", ",[]", "]}"),
      repeats("gltf", "deep lists", "", "["),
      counts("gltf", "members", R"({"asset":{"version":"2.0"})", ",\"#\":0"),
      repeats("gltf", "accessors", R"({"asset":{"version":"2.0"},"accessors":[{})", ",{}", "]}"),
      repeats("gltf", "a long name", R"({"asset":{"version":"2.0","name":")", "a", "\"}}"),
  };
}

Hard packed_model(const std::string& name, const std::string& head, const std::string& part, const std::string& tail) {
  return {"threemf", name, [=](std::size_t size) {
            // What does not pack keeps the file at its size.
            std::string noise;
            for (std::uint32_t x = 1; noise.size() < size; noise += as_bytes(x)) {
              x ^= x << 13, x ^= x >> 17, x ^= x << 5;
            }
            return zip({{"3D/3dmodel.model", repeated(15 * size, head, part, tail)}, {"noise", noise}});
          }};
}

std::vector<Hard> archives_and_scans() {
  const std::string object = "<model><resources><object id=\"1\"><mesh><vertices>";
  const std::string end = "</vertices></mesh></object></resources></model>";
  return {
      packed_model("vertices", object, "<vertex x=\"0\" y=\"0\" z=\"0\"/>", end),
      packed_model("triangles", object + "<vertex x=\"0\" y=\"0\" z=\"0\"/>", "<triangle v1=\"0\" v2=\"0\" v3=\"0\"/>",
                   end),
      packed_model("components", "<model><resources><object id=\"1\">", "<component objectid=\"1\"/>",
                   "</object></resources></model>"),
      packed_model("objects", "<model>", "<object id=\"1\"/>", "</model>"),
      packed_model("items", object + "<vertex x=\"0\" y=\"0\" z=\"0\"/></vertices></mesh></object>",
                   "<item objectid=\"1\"/>", "</resources></model>"),
      packed_model("nesting", "<model>", "<a>", ""),
      packed_model("one word", "<model a=\"", "b", "\"/>"),
      counts("threemf", "names", "<model>", "<a#/>"),
      counts("threemf", "objects of their own", "<model>", "<object id=\"#\"/>"),
      counts("threemf", "files", "<model><object id=\"1\">", "<component objectid=\"1\" path=\"#\"/>"),
      {"numpy", "bytes",
       [](std::size_t size) {
         std::string header =
             "{'descr': '|u1', 'fortran_order': False, 'shape': (" + std::to_string(size / 3) + ", 3), }";
         header.resize(100, ' ');
         return "\x93NUMPY\1\0\x64\0"s + header + std::string(size, '\1');
       }},
      repeats("numpy", "a long header", "\x93NUMPY\2\0\xFF\xFF\xFF\0"s, "(1,"),
      {"las", "points",
       [](std::size_t size) {
         std::string header = "LASF" + std::string(20, '\0') + "\1\2";
         header.resize(227);
         const auto put = [&](std::size_t at, const std::string& bytes) { header.replace(at, bytes.size(), bytes); };
         put(96, as_bytes(std::uint32_t{227}));
         put(105, as_bytes(std::uint16_t{20}));
         put(107, as_bytes(static_cast<std::uint32_t>(size / 20)));
         return header + std::string(size, '\0');
       }},
      {"kitti", "points", [](std::size_t size) { return std::string(size / 16 * 16, '\0'); }},
  };
}

std::vector<Hard> lists_and_records() {
  return {
      repeats("csv", "short rows", "path,category\n", "a,b\n"),
      counts("csv", "rows", "path,category\n", "models/chairs/chair-#.off,chair\n"),
      counts("csv", "categories", "path,category\n", "a,#\n"),
      counts("csv", "classes", "class,category\n", "#,a\n"),
      repeats("csv", "columns", "path,category", ","),
      repeats("csv", "one field", "path,category\n\"", "a"),
      repeats("csv", "a path of many folders", "path,category\n", "a/"),
      repeats("csv", "comments", "path,category\n", "#\n"),
      counts("cla", "models", "PSB 1\n1 #\na 0 #", "\n1"),
      counts("cla", "classes", "PSB 1\n# 0", "\nc# 0 0"),
      {"cla", "a chain of classes",
       [](std::size_t size) {
         std::string classes = "\n1 0 0";
         std::size_t count = 1;
         for (; classes.size() < size; ++count) {
           classes += "\n" + std::to_string(count + 1) + " " + std::to_string(count) + " 0";
         }
         return "PSB 1\n" + std::to_string(count) + " 0" + classes;
       }},
      {"cla", "models below a chain of classes", cla_of_a_chain},
      {"model", "a list of numbers", [](std::size_t size) { return cbor_array(size, "\1"); }},
      {"model", "a list of empty lists", [](std::size_t size) { return cbor_array(size, "\x80"); }},
      {"model", "a list of empty names", [](std::size_t size) { return cbor_array(size, "\x60"); }},
      {"model", "a list of small maps", [](std::size_t size) { return cbor_array(size, "\xA1\x60\1"); }},
      {"model", "deep lists", [](std::size_t size) { return std::string(size, '\x81'); }},
      {"model", "one blob",
       [](std::size_t size) {
         return "\xA1\x60\x5A"s + big_endian(static_cast<std::uint32_t>(size)) + std::string(size, 'x');
       }},
      {"journal", "records of nothing", short_records},
      {"sweep", "a line of lists", [](std::size_t size) { return repeated(size, kSweep, "[", "\n"); }},
      {"sweep", "a line of numbers", [](std::size_t size) { return repeated(size, kSweep + "[0", ",0", "]\n"); }},
      counts("sweep", "points", kSweep,
             R"({"values":["#"],"mean_class_rate":[1,1,1,1],"overall_rate":[1,1,1,1],"seconds":[1,1,1,1,1]})"
             "\n"),
      repeats("settings", "a long value", "encoding=", "a"),
  };
}

}  // namespace

std::vector<Hard> hard_files() {
  std::vector<Hard> all = object_files();
  for (const auto& more : {gltf_files(), archives_and_scans(), lists_and_records(), recordings()}) {
    all.insert(all.end(), more.begin(), more.end());
  }
  return all;
}

std::ostream& operator<<(std::ostream& stream, const Hard& hard) {
  return stream << hard.reader << ": " << hard.name;
}

}  // namespace spincat::test
