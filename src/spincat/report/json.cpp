#include "spincat/report/json.h"

#include <nlohmann/json.hpp>
#include <numeric>

#include "spincat/pipeline/settings_json.h"

namespace spincat {
namespace {

using Json = nlohmann::ordered_json;

std::string line(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Json stage_seconds(const StageSeconds& seconds) {
  return {{"read", seconds.read},
          {"prepare", seconds.prepare},
          {"spin", seconds.spin},
          {"encode", seconds.encode},
          {"judge", seconds.judge}};
}

Json skipped_objects(const std::vector<SkippedObject>& skipped) {
  Json list = Json::array();
  for (const SkippedObject& each : skipped) {
    list.push_back({{"file", each.file.string()}, {"error", each.reason}});
  }
  return list;
}

Json by_category(const std::vector<std::string>& categories, const std::vector<std::uint32_t>& counts) {
  Json json = Json::object();
  for (std::size_t c = 0; c < categories.size(); ++c) {
    json[categories[c]] = counts[c];
  }
  return json;
}

Json model_facts(const std::string& file, const Model& model) {
  return {{"file", file},
          {"kind", "model"},
          {"made_by", model.made_by},
          {"dataset", model.dataset},
          {"categories", model.categories},
          {"object_counts", by_category(model.categories, model.object_counts)},
          {"features", model.feature_length()},
          {"judges", model.judges.size()},
          {"settings", settings_to_json(model.settings)}};
}

}  // namespace

std::string classification_json(const std::string& file, const Classification& classification, const Model& model,
                                bool every_judge) {
  const Ballot& ballot = classification.ballot;
  const StageSeconds& s = classification.seconds;
  Json json = {{"file", file},
               {"category", model.categories[ballot.winner]},
               {"confidence", classification.confidence},
               {"votes", by_category(model.categories, ballot.count)},
               {"milliseconds", 1e3 * (s.read + s.prepare + s.spin + s.encode + s.judge)}};
  if (every_judge) {
    Json judges = Json::array();
    for (const Vote& vote : ballot.votes) {
      judges.push_back({{"a", model.categories[vote.category_a]},
                        {"b", model.categories[vote.category_b]},
                        {"vote", model.categories[vote.choice()]},
                        {"margin", vote.margin}});
    }
    json["judges"] = judges;
  }
  return line(json);
}

std::string error_json(const std::string& file, const std::string& error) {
  return line({{"file", file}, {"error", error}});
}

std::string evaluation_json(const Evaluation& e, const Settings& settings) {
  const std::size_t objects = std::accumulate(e.object_counts.begin(), e.object_counts.end(), std::size_t{0});
  return line({{"dataset", e.dataset},
               {"objects", objects},
               {"categories", e.categories},
               {"splits", e.splits},
               {"mean_class_rate", e.mean_class_rate.mean},
               {"mean_class_rate_std", e.mean_class_rate.deviation},
               {"overall_rate", e.overall_rate.mean},
               {"overall_rate_std", e.overall_rate.deviation},
               {"confusion", e.confusion},
               {"seconds", e.wall_seconds},
               {"object_counts", by_category(e.categories, e.object_counts)},
               {"stage_seconds", stage_seconds(e.seconds)},
               {"settings", settings_to_json(settings)},
               {"skipped", skipped_objects(e.skipped)}});
}

std::string model_json(const std::string& file, const Model& model) {
  return line(model_facts(file, model));
}

std::string training_json(const std::string& file, const TrainResult& result) {
  Json json = model_facts(file, result.model);
  json["stage_seconds"] = stage_seconds(result.seconds);
  json["skipped"] = skipped_objects(result.skipped);
  return line(json);
}

std::string object_json(const std::string& file, const ObjectFacts& facts) {
  const Vec3 size = facts.high - facts.low;
  return line({{"file", file},
               {"kind", facts.is_mesh ? "mesh" : "point cloud"},
               {"points", facts.points},
               {"triangles", facts.triangles},
               {"size", {size.x(), size.y(), size.z()}},
               {"area", facts.area},
               {"resolution", facts.resolution},
               {"defects",
                {{"repeated_points", facts.repeated_points},
                 {"unused_vertices", facts.unused_vertices},
                 {"flat_triangles", facts.flat_triangles},
                 {"repeated_triangles", facts.repeated_triangles}}}});
}

std::string spin_json(const std::string& file, std::size_t spin_points, const SpinImageParams& params,
                      const PreparedObject& object) {
  const SpinImageShape shape = params.shape();
  return line({{"file", file},
               {"spin_points", spin_points},
               {"surface_points", object.surface.size()},
               {"channels", shape.channels},
               {"rows", shape.rows},
               {"columns", shape.columns},
               {"bin_size", params.bin_size / object.scale}});
}

}  // namespace spincat
