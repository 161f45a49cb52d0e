#include "spincat/report/object_page.h"

#include <algorithm>

#include "spincat/prepare/defects.h"
#include "spincat/report/embedded.h"
#include "spincat/report/evidence_json.h"
#include "spincat/report/json.h"
#include "spincat/report/page_parts.h"
#include "spincat/report/report.h"
#include "spincat/report/shape_json.h"
#include "spincat/settings/settings_json.h"
#include "spincat/version.h"

namespace spincat {
namespace {

constexpr std::size_t kMostDots = 4096;       // surface or spin points that are drawn
constexpr std::size_t kMostDefects = 20'000;  // triangles of one defect that are drawn
constexpr std::size_t kShapeBytes = 72'000;   // of an object that has a page to itself

Json run_json(const std::vector<std::string>& command) {
  return {{"command", command}, {"version", kProgram}};
}

std::vector<std::string_view> scripts_with(std::string_view script) {
  return {embedded::three_js(), embedded::controls_js(), embedded::viewer_js(), script};
}

Json points_json(const OrientedPoints& points) {
  const std::size_t shown = std::min(points.size(), kMostDots);
  return {{"count", points.size()},
          {"points", base64_positions(points, shown)},
          {"normals", base64_normals(points, shown)}};
}

Json defects_json(const Object& object, const PreparedObject& prepared) {
  const auto* mesh = std::get_if<Mesh>(&object);
  if (mesh == nullptr) {
    return Json::object();
  }
  const MeshDefects defects = defects_of(*mesh);
  const auto corners = [&](const std::vector<std::uint32_t>& triangles) {
    return base64_triangles(*mesh, triangles, prepared, kMostDefects);
  };
  return {{"flat_triangles", corners(defects.flat)},
          {"repeated_triangles", corners(defects.repeated)},
          {"flipped_triangles", corners(defects.flipped)}};
}

}  // namespace

PageDetail page_detail(std::size_t objects) {
  constexpr std::size_t kAllShapes = 2'000'000;
  constexpr std::size_t kFew = 28;
  const std::size_t each = kAllShapes / std::max<std::size_t>(objects, 1);
  return {std::clamp<std::size_t>(each, 12'000, kShapeBytes), objects <= kFew ? std::size_t{64} : std::size_t{20}};
}

PageObject page_object(const std::string& file, const Classification& classification, const Model& model,
                       const Object& object, const Evidence& evidence, const PageDetail& detail, bool rejected) {
  const Json details = {
      {"margins", margins_json(classification.ballot)},
      {"evidence", evidence_json(evidence, detail.image_rows)},
      {"shape", shape_json(object, evidence.parts.front().prepared.preparation.object, detail.shape_bytes)}};
  return {classification_json(file, classification, model, false, rejected), line(details)};
}

PageObject page_object_error(const std::string& file, const std::string& error) {
  return {error_json(file, error), {}};
}

std::string classification_page(const std::string& model_file, const Model& model,
                                const std::vector<PageObject>& objects, const std::vector<std::string>& command) {
  Json list = Json::array();
  std::vector<PagePart> parts;
  for (const PageObject& object : objects) {
    Json json = {{"result", Json::parse(object.result)}};
    if (!object.details.empty()) {
      parts.push_back({"object-" + std::to_string(list.size()), object.details});
      json["part"] = parts.back().id;
    }
    list.push_back(std::move(json));
  }
  const Json data = {{"kind", "classification"},
                     {"model", Json::parse(model_json(model_file, model))},
                     {"objects", list},
                     {"run", run_json(command)}};
  return page(data, parts, scripts_with(embedded::classification_js()));
}

std::string object_page(const std::string& file, const Object& object, const ObjectFacts& facts,
                        const Preparation& preparation, const Settings& settings,
                        const std::vector<std::string>& command) {
  const Json shown = {{"shape", shape_json(object, preparation.object, kShapeBytes)},
                      {"surface", points_json(preparation.object.surface)},
                      {"spin", points_json(preparation.object.spin_points)},
                      {"defects", defects_json(object, preparation.object)}};
  const Json data = {{"kind", "object"},
                     {"result", Json::parse(object_json(file, facts))},
                     {"settings", settings_to_json(settings)},
                     {"run", run_json(command)}};
  return page(data, {{"object-0", line(shown)}}, scripts_with(embedded::object_js()));
}

}  // namespace spincat
