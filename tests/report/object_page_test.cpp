// Pages with objects: what is in the file. What a browser makes of it is in browser/check_pages.py.
#include "spincat/report/object_page.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <numbers>

#include "spincat/classify/model_data.h"
#include "spincat/report/base64.h"
#include "spincat/report/evidence_json.h"
#include "spincat/report/json.h"
#include "spincat/report/report.h"
#include "spincat/report/shape_json.h"
#include "spincat/train/train.h"
#include "support/shapes.h"
#include "support/temp_dir.h"

namespace spincat {
namespace {

const std::string kNasty = "<b>\"bed\" & 'couch'</script><!-- {{script}} 🪑 בית";

std::vector<std::uint8_t> decoded(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<std::uint8_t> bytes;
  unsigned bits = 0;
  int known = 0;
  for (const char c : text) {
    if (c == '=') {
      break;
    }
    bits = bits << 6U | static_cast<unsigned>(digits.find(c));
    known += 6;
    if (known >= 8) {
      known -= 8;
      bytes.push_back(static_cast<std::uint8_t>(bits >> static_cast<unsigned>(known)));
    }
  }
  return bytes;
}

template <class T>
std::vector<T> numbers_of(const Json& text) {
  const std::vector<std::uint8_t> bytes = decoded(text.get<std::string>());
  std::vector<T> values(bytes.size() / sizeof(T));
  std::memcpy(values.data(), bytes.data(), values.size() * sizeof(T));
  return values;
}

Json element(const std::string& page, const std::string& id) {
  const std::string begin = "<script type=\"application/json\" id=\"" + id + "\">";
  const std::size_t from = page.find(begin) + begin.size();
  return Json::parse(page.substr(from, page.find("</script>", from) - from));
}

PreparedObject unit_frame() {
  PreparedObject frame;
  frame.scale = 0.5;
  frame.centre = {1, 0, 0};
  return frame;
}

TEST(Base64, IsThatOfRfc4648) {
  const auto of = [](const std::string& text) { return base64(std::vector<std::uint8_t>(text.begin(), text.end())); };
  EXPECT_EQ(of(""), "");
  EXPECT_EQ(of("f"), "Zg==");
  EXPECT_EQ(of("fo"), "Zm8=");
  EXPECT_EQ(of("foo"), "Zm9v");
  EXPECT_EQ(of("foob"), "Zm9vYg==");
  EXPECT_EQ(of("\xFF\xFE\xFD"), "//79");
}

TEST(ShapeJson, HoldsASmallMeshAsItIs) {
  Mesh mesh;
  mesh.vertices = {{3, 0, 0}, {1, 2, 0}, {1, 0, -2}, {9, 9, 9}};
  mesh.triangles = {{0, 1, 2}};
  const Json shape = shape_json(mesh, unit_frame(), 1000);
  EXPECT_EQ(shape["of"], 1);
  const auto points = numbers_of<std::int16_t>(shape["points"]);
  const auto corners = numbers_of<std::uint16_t>(shape["triangles"]);
  ASSERT_EQ(points.size(), 9U);
  ASSERT_EQ(corners.size(), 3U);
  const auto corner = [&](std::size_t k) {
    return std::vector<int>(points.begin() + 3 * corners[k], points.begin() + 3 * corners[k] + 3);
  };
  EXPECT_EQ(corner(0), (std::vector<int>{16384, 0, 0}));
  EXPECT_EQ(corner(1), (std::vector<int>{0, 16384, 0}));
  EXPECT_EQ(corner(2), (std::vector<int>{0, 0, -16384}));
}

TEST(ShapeJson, SimplifiesALargeMeshAndThinsACloud) {
  const Mesh ball = test::icosphere(5);  // 20,480 triangles
  PreparedObject frame;
  const Json shape = shape_json(ball, frame, 12'000);
  EXPECT_EQ(shape["of"], 20'480);
  const auto corners = numbers_of<std::uint16_t>(shape["triangles"]);
  const auto points = numbers_of<std::int16_t>(shape["points"]);
  EXPECT_GT(corners.size(), 3U * 500U);
  EXPECT_LE(shape["points"].get<std::string>().size() + shape["triangles"].get<std::string>().size(), 15'000U);
  for (const std::uint16_t corner : corners) {
    ASSERT_LT(3U * corner, points.size());
    const Vec3 p(points[3 * corner], points[3 * corner + 1], points[3 * corner + 2]);
    EXPECT_NEAR(p.norm() / 16383.5, 1.0, 1e-3);  // vertices are kept, so they are on the ball
  }
  const Json cloud = shape_json(PointCloud{test::sphere_points(5000), {}, {}}, frame, 8000);
  EXPECT_EQ(numbers_of<std::int16_t>(cloud["points"]).size(), 3U * 1000U);
  EXPECT_FALSE(cloud.contains("triangles"));
}

TEST(MarginsJson, AreThousandthsOrCoarserWhereTheyAreLarge) {
  const auto of = [](std::vector<float> margins) { return margins_json(count_votes(3, margins)); };
  const Json small = of({0.1234F, -2.0F, 32.0F});
  EXPECT_DOUBLE_EQ(small["unit"].get<double>(), 0.001);
  EXPECT_EQ(numbers_of<std::int16_t>(small["values"]), (std::vector<std::int16_t>{123, -2000, 32000}));
  const Json large = of({0.1234F, -2.0F, 33.0F});
  EXPECT_DOUBLE_EQ(large["unit"].get<double>(), 0.01);
  EXPECT_EQ(numbers_of<std::int16_t>(large["values"]), (std::vector<std::int16_t>{12, -200, 3300}));
}

// Two categories with nasty names.
Model trained() {
  const test::TempDir dir;
  for (int k = 0; k < 3; ++k) {
    dir.write(fmt::format("d/box/{}.off", k), test::off_text(test::box(1, 1.0 + 0.1 * k, 1.2)));
    dir.write(fmt::format("d/cone/{}.off", k), test::off_text(test::cylinder(16, 0.6, 0.0, 1.0 + 0.1 * k)));
  }
  Settings settings = preset("default");
  settings.prepare.points = 300;
  settings.prepare.spin_points = 24;
  settings.spin.image_width = 24;
  settings.copies = 0;
  ModelData model = train(read_dataset({dir / "d"}), settings).model.data();
  model.categories = {kNasty, "cone"};
  return model;
}

std::size_t count(const std::string& text, const std::string& wanted) {
  std::size_t found = 0;
  for (std::size_t at = text.find(wanted); at != std::string::npos; at = text.find(wanted, at + 1)) {
    ++found;
  }
  return found;
}

TEST(ClassificationPage, HoldsTheAnswersAndWhereTheirEvidenceLies) {
  const Model model = trained();
  const Object object = test::box(1, 1.15, 1.2);
  const Classification found = classify(model, object);
  const Evidence evidence = explain(model, object, found.ballot);
  const std::string file = kNasty + ".off";
  const PageObject shown = page_object(file, found, model, object, evidence, page_detail(600));
  const PageObject failed = page_object_error("missing.off", "missing.off: no such file");
  const std::string page = classification_page("m.spincat", model, {failed, shown}, {"spincat", "classify"});

  const Json data = element(page, "data");
  EXPECT_EQ(data["kind"], "classification");
  EXPECT_EQ(data["model"], Json::parse(model_json("m.spincat", model)));
  ASSERT_EQ(data["objects"].size(), 2U);
  EXPECT_EQ(data["objects"][0].dump(), R"({"result":{"file":"missing.off","error":"missing.off: no such file"}})");
  EXPECT_EQ(data["objects"][1]["result"], Json::parse(classification_json(file, found, model, false)));
  const Json part = element(page, data["objects"][1]["part"]);
  EXPECT_EQ(part["evidence"]["kind"], "shares");
  EXPECT_EQ(part["evidence"]["winner"], found.ballot.winner);
  EXPECT_EQ(numbers_of<std::int16_t>(part["margins"]["values"])[0],
            std::lround(1000.0 * static_cast<double>(found.ballot.votes[0].margin)));
  ASSERT_EQ(part["evidence"]["parts"].size(), 3U);
  const Json& first = part["evidence"]["parts"][0];
  EXPECT_EQ(numbers_of<std::int16_t>(first["points"]).size(), 3U * 24U);
  const auto values = numbers_of<std::int16_t>(first["values"]);
  ASSERT_EQ(values.size(), 24U);
  for (std::size_t k = 0; k < 24; ++k) {
    EXPECT_NEAR(values[k] / 32767.0 * first["strongest"].get<double>(), evidence.parts[0].of_point[k], 1e-4);
  }
  for (const Json& image : part["evidence"]["images"]) {
    EXPECT_EQ(image["rows"], 12);  // 24 rows are too many
    EXPECT_EQ(numbers_of<std::uint8_t>(image["values"]).size(), 2U * 12U * 12U);
  }
  EXPECT_EQ(count(page, "<b>"), count(classification_page("m", model, std::vector<PageObject>{}, {}), "<b>"));
}

TEST(ClassificationPage, SixHundredObjectsOfNinetyCategoriesStaySmall) {
  // The parts that grow: 4,005 margins, the largest shapes and images that page_detail lets pass, 512 spin points.
  const PageDetail detail = page_detail(600);
  Json margins = margins_json(count_votes(90, std::vector<float>(4005, -1.5F)));
  const std::size_t shape = shape_json(test::icosphere(5), PreparedObject(), detail.shape_bytes).dump().size();
  const std::size_t points = 2 * 256 * 8 * 4 / 3;
  const std::size_t images = 8 * (detail.image_rows * detail.image_rows * 2 * 4 / 3 + 100);
  EXPECT_LT(600 * (margins.dump().size() + shape + points + images + 2000), 24'000'000U);
  EXPECT_EQ(page_detail(1).shape_bytes, 72'000U);
  EXPECT_GE(page_detail(1).image_rows, 40U);
}

TEST(ObjectPage, HoldsTheFactsAndTheBrokenTriangles) {
  Mesh mesh = test::box();
  std::swap(mesh.triangles[3][1], mesh.triangles[3][2]);
  mesh.triangles.push_back({0, 0, 1});
  const Settings settings = preset("default");
  const std::string page =
      object_page(kNasty, mesh, facts_of(mesh), prepare_object(mesh, settings), settings, {"spincat", "info"});
  const Json data = element(page, "data");
  EXPECT_EQ(data["kind"], "object");
  EXPECT_EQ(data["result"], Json::parse(object_json(kNasty, facts_of(mesh))));
  const Json part = element(page, "object-0");
  EXPECT_EQ(part["surface"]["count"], 2048);
  EXPECT_EQ(part["spin"]["count"], 256);
  EXPECT_EQ(numbers_of<std::int16_t>(part["surface"]["normals"]).size(), 3U * 2048U);
  const auto flipped = numbers_of<std::int16_t>(part["defects"]["flipped_triangles"]);
  ASSERT_EQ(flipped.size(), 9U);
  for (std::size_t corner = 0; corner < 3;
       ++corner) {  // face 3 is on the side of +x; corners are at distance 1 or more
    EXPECT_NEAR(flipped[3 * corner] / 16383.5, 1.0 / std::numbers::sqrt3, 0.02);
    EXPECT_NEAR(std::abs(flipped[3 * corner + 1]), flipped[3 * corner], 1);
  }
  EXPECT_EQ(numbers_of<std::int16_t>(part["defects"]["flat_triangles"]).size(), 9U);
  EXPECT_EQ(part["defects"]["repeated_triangles"], "");
}

}  // namespace
}  // namespace spincat
