// 3MF, the format of 3D printing: a ZIP archive of XML files with meshes, of which others are put together, and a list
// of what is to be built.
#include <fmt/format.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "spincat/error.h"
#include "spincat/geometry/object.h"
#include "spincat/io/formats/format.h"
#include "spincat/io/formats/object_builder.h"
#include "spincat/io/formats/xml.h"
#include "spincat/io/formats/zip.h"
#include "spincat/io/read_limits.h"
#include "spincat/io/text_cursor.h"

namespace spincat::io {
namespace {

// The number of a file of the archive (Parts::paths), and that of an object in it.
using PartId = std::pair<std::size_t, std::uint32_t>;

struct Placed {
  PartId part;
  Eigen::Matrix4d transform = Eigen::Matrix4d::Identity();
};

// An object of the file: a mesh, or others put together.
struct Part {
  std::size_t first_vertex = 0, end_of_vertices = 0;
  std::size_t first_triangle = 0, end_of_triangles = 0;
  std::vector<Placed> components;
  bool is_model = true;  // no support, which is broken off after printing
};

// All that the files of an archive hold.
struct Parts {
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;  // numbers of vertices within their part
  std::map<PartId, Part> parts;
  std::vector<Placed> items;       // to be built
  std::size_t placed = 0;          // items and components
  std::vector<std::string> paths;  // of the files, each named once, the root first
  std::map<std::string, std::size_t> numbers;
  std::uint64_t path_bytes = 0;

  std::size_t number_of(const std::string& path) {
    const auto [found, is_new] = numbers.try_emplace(path, paths.size());
    if (is_new) {
      paths.push_back(path);
      path_bytes += 2 * path.size();
    }
    return found->second;
  }

  std::uint64_t memory() const {
    constexpr std::uint64_t kWhileGrowing = 3, kForEachPart = 400;
    return kWhileGrowing *
               (vertices.size() * sizeof(Vec3) + triangles.size() * sizeof(Triangle) + placed * (sizeof(Placed) + 64)) +
           kForEachPart * parts.size();
  }
};

// "/3D/a.model" and "3D/a.model" are the same.
std::string without_slash(std::string_view path) {
  return std::string(path.substr(path.starts_with('/') ? 1 : 0));
}

template <class Number>
std::optional<Number> parse_number(std::string_view& text) {
  text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
  text.remove_prefix(text.starts_with('+') ? 1 : 0);
  Number number{};
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc()) {
    return std::nullopt;
  }
  text.remove_prefix(static_cast<std::size_t>(stop - text.data()));
  return number;
}

// What one .model file says.
class ModelReader : public XmlHandler {
 public:
  ModelReader(std::size_t path, Parts& parts) : path_(path), parts_(parts) {}

  void begin(std::string_view space, std::string_view name, const XmlAttributes& attributes) override {
    if (!space.empty() && space.find("/3dmanufacturing/core/") == std::string_view::npos) {
      return;  // an extension: colours, slices, beams, ...
    }
    if (name == "vertex" && part_ != nullptr) {
      parts_.vertices.emplace_back(coordinate(attributes, "x"), coordinate(attributes, "y"),
                                   coordinate(attributes, "z"));
      part_->end_of_vertices = parts_.vertices.size();
    } else if (name == "triangle" && part_ != nullptr) {
      parts_.triangles.push_back({corner(attributes, "v1"), corner(attributes, "v2"), corner(attributes, "v3")});
      part_->end_of_triangles = parts_.triangles.size();
    } else if (name == "object") {
      begin_object(attributes);
    } else if (name == "component" && part_ != nullptr) {
      part_->components.push_back(placed(attributes));
    } else if (name == "item" && path_ == 0) {
      parts_.items.push_back(placed(attributes));
    }
  }

  void end(std::string_view, std::string_view name) override {
    if (name == "object") {
      part_ = nullptr;
    }
  }

 private:
  void begin_object(const XmlAttributes& attributes) {
    const std::string_view type = attributes.find("type").value_or("model");
    part_ = &parts_.parts[{path_, number(attributes, "id")}];
    *part_ = {parts_.vertices.size(),
              parts_.vertices.size(),
              parts_.triangles.size(),
              parts_.triangles.size(),
              {},
              type == "model" || type == "surface"};
  }

  Placed placed(const XmlAttributes& attributes) {
    ++parts_.placed;
    Placed result;
    const auto path = attributes.find("path");
    result.part = {path ? parts_.number_of(without_slash(*path)) : path_, number(attributes, "objectid")};
    if (const auto text = attributes.find("transform")) {
      result.transform = transform(*text);
    }
    return result;
  }

  // Three rows of a rotation and a row of a translation, for points that are rows themselves.
  static Eigen::Matrix4d transform(std::string_view text) {
    Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
    const std::string_view all = text;
    for (int i = 0; i < 12; ++i) {
      const std::optional<double> value = parse_number<double>(text);
      if (!value) {
        throw InputError(fmt::format("expected 12 numbers of a transform, found {}", in_quotes(all)));
      }
      matrix(i % 3, i / 3) = *value;
    }
    return matrix;
  }

  static std::string_view required(const XmlAttributes& attributes, std::string_view name) {
    const auto text = attributes.find(name);
    if (!text) {
      throw InputError(fmt::format("expected the attribute '{}'", name));
    }
    return *text;
  }

  static double coordinate(const XmlAttributes& attributes, std::string_view name) {
    std::string_view text = required(attributes, name);
    const std::string_view all = text;
    const std::optional<double> value = parse_number<double>(text);
    if (!value || !std::isfinite(*value) || text.find_first_not_of(" \t\r\n") != std::string_view::npos) {
      throw InputError(fmt::format("expected a coordinate {}, found {}", name, in_quotes(all)));
    }
    return *value;
  }

  static std::uint32_t number(const XmlAttributes& attributes, std::string_view name) {
    std::string_view text = required(attributes, name);
    const std::string_view all = text;
    const std::optional<std::uint32_t> value = parse_number<std::uint32_t>(text);
    if (!value || text.find_first_not_of(" \t\r\n") != std::string_view::npos) {
      throw InputError(fmt::format("expected the number '{}', found {}", name, in_quotes(all)));
    }
    return *value;
  }

  // Vertices stand before triangles.
  std::uint32_t corner(const XmlAttributes& attributes, std::string_view name) const {
    const std::uint32_t index = number(attributes, name);
    const std::size_t vertices = part_->end_of_vertices - part_->first_vertex;
    if (index >= vertices) {
      throw InputError(out_of_range(index, vertices));
    }
    return index;
  }

  std::size_t path_;
  Parts& parts_;
  Part* part_ = nullptr;  // the object that is being read
};

// Which file of the archive is the model: that which _rels/.rels names.
class RelationReader : public XmlHandler {
 public:
  void begin(std::string_view, std::string_view name, const XmlAttributes& attributes) override {
    const auto type = attributes.find("Type"), target = attributes.find("Target");
    if (name == "Relationship" && type && target && type->ends_with("/3dmodel") && !target_) {
      target_ = without_slash(*target);
    }
  }
  void end(std::string_view, std::string_view) override {}

  const std::optional<std::string>& target() const { return target_; }

 private:
  std::optional<std::string> target_;
};

class ThreeMfReader {
 public:
  ThreeMfReader(std::string_view bytes, const ReadLimits& limits)
      : size_(bytes.size()), limits_(limits), zip_(bytes), object_(limits) {}

  Object read() {
    constexpr std::size_t kMostEntries = 10'000;  // each is looked up among the others
    if (zip_.entries().size() > kMostEntries) {
      throw InputError(fmt::format("is an archive of more than {} parts", kMostEntries));
    }
    parts_.number_of(std::string(find_root().name));
    for (std::size_t i = 0; i < parts_.paths.size(); ++i) {  // which name others
      if (const ZipEntry* entry = zip_.find(parts_.paths[i])) {
        ModelReader reader(i, parts_);
        parse(*entry, reader);
      }
    }
    if (parts_.items.empty()) {
      for (const auto& [id, part] : parts_.parts) {
        if (part.components.empty()) {
          add({id, Eigen::Matrix4d::Identity()}, Eigen::Matrix4d::Identity(), 0);
        }
      }
    }
    for (const Placed& item : parts_.items) {
      add(item, item.transform, 0);
    }
    return object_.finish();
  }

 private:
  const ZipEntry& find_root() {
    RelationReader relations;
    if (const ZipEntry* entry = zip_.find("_rels/.rels")) {
      parse(*entry, relations);
    }
    const ZipEntry* root = zip_.find(relations.target().value_or("3D/3dmodel.model"));
    for (const ZipEntry& entry : zip_.entries()) {
      if (root == nullptr && entry.name.ends_with(".model")) {
        root = &entry;
      }
    }
    if (root == nullptr) {
      throw InputError("is no 3MF file: its archive holds no model");
    }
    return *root;
  }

  // The text streams by, but it takes time.
  void parse(const ZipEntry& entry, XmlHandler& handler) {
    read_ += entry.size;
    check_growth(read_, size_, limits_);
    XmlParser parser(handler);
    zip_.unpack(entry, [&](std::string_view piece) {
      parser.feed(piece);
      check_growth(parts_.memory(), size_, limits_);
      object_.check_vertices(parts_.vertices.size());
      object_.check_triangles(parts_.triangles.size());
      return true;
    });
    parser.finish();
  }

  void add(const Placed& placed, const Eigen::Matrix4d& transform, int depth) {
    constexpr int kDeepest = 32;
    constexpr std::uint64_t kForEachVisit = 64;  // what takes time counts as if it took memory
    if (depth > kDeepest) {
      throw InputError(fmt::format("its objects are nested more than {} deep", kDeepest));
    }
    const auto found = parts_.parts.find(placed.part);
    if (found == parts_.parts.end()) {
      throw InputError(fmt::format("its object {} of {} does not exist", placed.part.second,
                                   in_quotes(parts_.paths[placed.part.first])));
    }
    const Part& part = found->second;
    ++visits_;
    object_.check_more(part.end_of_vertices - part.first_vertex, part.end_of_triangles - part.first_triangle,
                       parts_.memory() + kForEachVisit * visits_, size_);
    if (!part.is_model) {
      return;
    }
    add_mesh(part, transform);
    for (const Placed& component : part.components) {
      add(component, transform * component.transform, depth + 1);
    }
  }

  void add_mesh(const Part& part, const Eigen::Matrix4d& transform) {
    const auto first = static_cast<std::uint32_t>(object_.vertices());
    object_.check_vertices(object_.vertices() + part.end_of_vertices - part.first_vertex);
    for (std::size_t i = part.first_vertex; i < part.end_of_vertices; ++i) {
      const Vec3 vertex = (transform * parts_.vertices[i].homogeneous()).head<3>();
      if (!vertex.allFinite()) {
        throw InputError("places a vertex where no finite number is");
      }
      object_.add_vertex(vertex);
    }
    const bool mirrored = transform.topLeftCorner<3, 3>().determinant() < 0;
    for (std::size_t i = part.first_triangle; i < part.end_of_triangles; ++i) {
      const auto [a, b, c] = parts_.triangles[i];
      object_.add_triangle(first + a, first + (mirrored ? c : b), first + (mirrored ? b : c));
    }
  }

  std::uint64_t size_;
  const ReadLimits& limits_;
  ZipArchive zip_;
  ObjectBuilder object_;
  Parts parts_;
  std::uint64_t read_ = 0;    // bytes of XML
  std::uint64_t visits_ = 0;  // of parts
};

Object read_threemf(const FileContent& file, const ReadLimits& limits) {
  return ThreeMfReader(file.bytes, limits).read();
}

}  // namespace

ObjectFormat threemf_format() {
  return {.extensions = {".3mf"}, .read = read_threemf};
}

}  // namespace spincat::io
