#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "io/bytes.h"
#include "io/reading.h"
#include "io/zip_bytes.h"

namespace spincat {
namespace {

using test::problem_with;
using test::read_mesh;
using test::zip;

const std::string kCore = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02";
const std::string kProduction = "http://schemas.microsoft.com/3dmanufacturing/production/2015/06";

const std::string kRelations =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?><Relationships "
    "xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\"><Relationship Id=\"r0\" "
    "Type=\"http://schemas.openxmlformats.org/package/2006/relationships/metadata/thumbnail\" "
    "Target=\"/Metadata/thumbnail.png\"/><Relationship Id=\"r1\" Target=\"/3D/box.model\" "
    "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/></Relationships>";

const std::vector<Vec3> kCorners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

// A corner of a cube, without its outer face.
const std::string kMesh =
    "<mesh><vertices><vertex x=\"0\" y=\"0\" z=\"0\"/><vertex x=\"1\" y=\"0\" z=\"0\"/><vertex x=\"0\" y=\"1e0\" "
    "z=\" 0 \"/><vertex x=\"0\" y=\"0\" z=\"+1.0\"/></vertices><triangles><triangle v1=\"0\" v2=\"2\" v3=\"1\"/>"
    "<triangle v1=\"0\" v2=\"1\" v3=\"3\" pid=\"1\" p1=\"0\"/></triangles></mesh>";

std::string object(int id, const std::string& content, const std::string& attributes = "type=\"model\"") {
  return fmt::format("<object id=\"{}\" {}>{}</object>", id, attributes, content);
}

std::string model(const std::string& objects, const std::string& items) {
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<model unit=\"millimeter\" xml:lang=\"en-US\" xmlns=\"" + kCore +
         "\" xmlns:p=\"" + kProduction +
         "\" xmlns:m=\"http://schemas.microsoft.com/3dmanufacturing/material/2015/02\">\n<metadata "
         "name=\"Title\">A &amp; B</metadata><resources><m:colorgroup id=\"9\"><m:color color=\"#FFFFFF\"/>"
         "</m:colorgroup>" +
         objects + "</resources><build>" + items + "</build></model>";
}

std::string package(const std::string& root, const std::vector<std::pair<std::string, std::string>>& more = {}) {
  std::vector<std::pair<std::string, std::string>> parts = {
      {"[Content_Types].xml", "<Types/>"}, {"_rels/.rels", kRelations}, {"3D/box.model", root}};
  parts.insert(parts.end(), more.begin(), more.end());
  return zip(parts);
}

Mesh read(const std::string& objects, const std::string& items) {
  return read_mesh("a.3mf", package(model(objects, items)));
}

std::string problem(const std::string& objects, const std::string& items) {
  return problem_with("a.3mf", package(model(objects, items)));
}

const std::string kItem = "<item objectid=\"1\"/>";

TEST(ThreeMf, ReadsAMesh) {
  const Mesh mesh = read(object(1, kMesh), kItem);
  EXPECT_EQ(mesh.vertices, kCorners);
  EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 2, 1}, {0, 1, 3}}));
  EXPECT_EQ(read_mesh("A.3MF", zip({{"3D/3dmodel.model", model(object(1, kMesh), kItem)}}, false)).vertices, kCorners);
  EXPECT_EQ(read_mesh("a.3mf", zip({{"3d/3DModel.model", model(object(1, kMesh), kItem)}})).vertices, kCorners);
  EXPECT_EQ(read_mesh("a.3mf", zip({{"else/where.model", model(object(1, kMesh), kItem)}})).vertices, kCorners);
}

// Each row of a transform is where an axis goes, the last one where the origin does.
TEST(ThreeMf, PlacesItemsByTheirTransforms) {
  const Mesh mesh = read(object(1, kMesh), "<item objectid=\"1\" transform=\"0 2 0 -1 0 0 0 0 1 10 20 30\"/>" + kItem);
  EXPECT_EQ(mesh.vertices,
            (std::vector<Vec3>{
                {10, 20, 30}, {10, 22, 30}, {9, 20, 30}, {10, 20, 31}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}));
  EXPECT_EQ(mesh.triangles[2], (Triangle{4, 6, 5}));
}

TEST(ThreeMf, TurnsMirroredFacesBack) {
  const Mesh mesh = read(object(1, kMesh), "<item objectid=\"1\" transform=\"-1 0 0 0 1 0 0 0 1 0 0 0\"/>");
  EXPECT_EQ(mesh.triangles[0], (Triangle{0, 1, 2}));
}

TEST(ThreeMf, PutsComponentsTogether) {
  const std::string two =
      "<components><component objectid=\"1\" transform=\"1 0 0 0 1 0 0 0 1 5 0 0\"/><component objectid=\"1\"/>"
      "</components>";
  const Mesh mesh =
      read(object(1, kMesh) + object(2, two), "<item objectid=\"2\" transform=\"2 0 0 0 2 0 0 0 2 0 0 1\"/>");
  ASSERT_EQ(mesh.vertices.size(), 8U);
  EXPECT_EQ(mesh.vertices[1], Vec3(12, 0, 1));
  EXPECT_EQ(mesh.vertices[5], Vec3(2, 0, 1));
}

TEST(ThreeMf, ReadsPartsOfOtherFiles) {
  const std::string part = model(object(7, kMesh), "<item objectid=\"7\"/>");
  const std::string root =
      model(object(2, "<components><component p:path=\"/3D/Objects/part.model\" objectid=\"7\"/></components>"),
            "<item objectid=\"2\"/><item objectid=\"7\" p:path=\"/3D/Objects/part.model\"/>");
  const Mesh mesh = read_mesh("a.3mf", package(root, {{"3D/Objects/part.model", part}}));
  EXPECT_EQ(mesh.vertices.size(), 8U);
  EXPECT_EQ(problem_with("a.3mf", package(root)), "its object 7 of '3D/Objects/part.model' does not exist");
}

TEST(ThreeMf, ReadsWhatIsToBeBuilt) {
  const Mesh mesh = read(object(1, kMesh) + object(2, kMesh) + object(3, kMesh, "type=\"support\""),
                         kItem + "<item objectid=\"3\"/>");
  EXPECT_EQ(mesh.vertices.size(), 4U);
  EXPECT_EQ(read(object(1, kMesh) + object(2, kMesh), "").vertices.size(), 8U);
}

TEST(ThreeMf, KeepsItsUnits) {
  std::string text = model(object(1, kMesh), kItem);
  text.replace(text.find("millimeter"), 10, "inch");
  EXPECT_EQ(read_mesh("a.3mf", package(text)).vertices, kCorners);
}

TEST(ThreeMf, RefusesInWords) {
  EXPECT_EQ(problem_with("a.3mf", "solid"), "is no ZIP archive, or is cut off");
  EXPECT_EQ(problem_with("a.3mf", zip({{"a.txt", "x"}})), "is no 3MF file: its archive holds no model");
  EXPECT_EQ(problem_with("a.3mf", package("<model>")), "line 1: no valid XML (no element found)");
  EXPECT_EQ(problem_with("a.3mf", package("model")), "line 1: no valid XML (syntax error)");
  EXPECT_EQ(problem(object(1, ""), kItem), "holds neither a face nor a point");
  EXPECT_EQ(problem(object(1, kMesh), "<item objectid=\"5\"/>"), "its object 5 of '3D/box.model' does not exist");
  EXPECT_EQ(problem(object(1, kMesh), "<item/>"), "line 3: expected the attribute 'objectid'");
  EXPECT_EQ(problem(object(1, kMesh), "<item objectid=\"1\" transform=\"1 0 0\"/>"),
            "line 3: expected 12 numbers of a transform, found '1 0 0'");
  std::string mesh = kMesh;
  EXPECT_EQ(problem(object(1, mesh.replace(mesh.find("v3=\"3\""), 6, "v3=\"4\"")), kItem),
            "line 3: vertex index 4 is out of range (4 vertices)");
  mesh = kMesh;
  EXPECT_EQ(problem(object(1, mesh.replace(mesh.find("1e0"), 3, "1,0")), kItem),
            "line 3: expected a coordinate y, found '1,0'");
  mesh = kMesh;
  EXPECT_EQ(problem(object(1, mesh.replace(mesh.find("1e0"), 3, "nan")), kItem),
            "line 3: expected a coordinate y, found 'nan'");
}

TEST(ThreeMf, EndsCircles) {
  const std::string itself = "<components><component objectid=\"1\"/></components>";
  EXPECT_EQ(problem(object(1, itself), kItem), "its objects are nested more than 32 deep");
}

// Each level shows the one below twice.
TEST(ThreeMf, BoundsWhatIsRepeated) {
  std::string objects = object(1, kMesh);
  for (int i = 2; i <= 30; ++i) {
    objects += object(
        i, fmt::format("<components><component objectid=\"{0}\"/><component objectid=\"{0}\"/></components>", i - 1));
  }
  const std::string text = problem(objects, "<item objectid=\"30\"/>");
  EXPECT_TRUE(text.starts_with("would take ") && text.ends_with("--max-growth raises this limit")) << text;
}

TEST(ThreeMf, BoundsWhatIsPacked) {
  const std::string text = problem(object(1, kMesh) + std::string(40'000'000, ' '), kItem);
  EXPECT_TRUE(text.starts_with("would take ") && text.ends_with("--max-growth raises this limit")) << text;
}

// expat keeps what it has not yet understood.
TEST(ThreeMf, BoundsNamesWordsAndNesting) {
  const std::string bounds = "line 3: names, words or nesting beyond all bounds";
  std::string deep;
  for (int i = 0; i < 200'000; ++i) {
    deep += "<a>";
  }
  std::string names;
  for (int i = 0; i < 200'000; ++i) {
    names += fmt::format("<a{}/>", i);
  }
  EXPECT_EQ(problem(deep, kItem), bounds);
  EXPECT_EQ(problem(names, kItem), bounds);
  EXPECT_EQ(problem("<a b=\"" + std::string(9'000'000, 'x') + "\"/>", kItem), bounds);
}

TEST(ThreeMf, RefusesTypesOfItsOwn) {
  std::string text = model(object(1, kMesh), kItem);
  text.insert(text.find('\n'), "<!DOCTYPE model [<!ENTITY a \"aaaa\"><!ENTITY b \"&a;&a;\">]>");
  EXPECT_EQ(problem_with("a.3mf", package(text)),
            "line 1: holds a document type definition, which spincat does not read");
}

TEST(ThreeMf, KeepsToTheLimits) {
  const std::string bytes = package(model(object(1, kMesh), kItem));
  EXPECT_EQ(problem_with("a.3mf", bytes, {.max_points = 3}),
            "holds more than 3 points; --max-points raises this limit");
  EXPECT_EQ(problem_with("a.3mf", bytes, {.max_triangles = 1}),
            "holds more than 1 triangles; --max-triangles raises this limit");
}

TEST(ThreeMf, SurvivesDamage) {
  const std::string small = "<model xmlns=\"" + kCore + "\"><resources>" + object(1, kMesh) + "</resources><build>" +
                            kItem + "</build></model>";
  test::expect_survives_damage("a.3mf", zip({{"3D/3dmodel.model", small}}, false));
  test::expect_survives_damage("a.3mf", zip({{"3D/3dmodel.model", small}}));
}

}  // namespace
}  // namespace spincat
