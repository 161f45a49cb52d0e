#include "spincat/report/json.h"

#include <nlohmann/json.hpp>

#include "spincat/report/json_parts.h"
#include "spincat/report/report.h"
#include "spincat/settings/settings_json.h"

namespace spincat {
namespace {

Json model_facts(const std::string& file, const Model& model) {
  return {{"file", file},
          {"kind", "model"},
          {"made_by", model.made_by()},
          {"dataset", model.dataset()},
          {"categories", model.categories()},
          {"object_counts", by_category(model.categories(), model.object_counts())},
          {"features", model.feature_length()},
          {"judges", model.judge_count()},
          {"settings", settings_to_json(model.settings())}};
}

}  // namespace

std::string classification_json(const std::string& file, const Classification& classification, const Model& model,
                                bool every_judge, bool rejected) {
  const Ballot& ballot = classification.ballot;
  const StageSeconds& s = classification.seconds;
  Json json = {{"file", file},
               {"category", rejected ? "unknown" : model.categories()[ballot.winner]},
               {"confidence", classification.confidence},
               {"known", classification.known},
               {"votes", by_category(model.categories(), ballot.count)},
               {"milliseconds", 1e3 * (s.read + s.prepare + s.spin + s.encode + s.judge)}};
  if (rejected) {
    json["best_guess"] = model.categories()[ballot.winner];
  }
  if (!classification.kind_mismatch.empty()) {
    json["kind_mismatch"] = classification.kind_mismatch;
  }
  if (every_judge) {
    Json judges = Json::array();
    for (const Vote& vote : ballot.votes) {
      judges.push_back({{"a", model.categories()[vote.category_a]},
                        {"b", model.categories()[vote.category_b]},
                        {"vote", model.categories()[vote.choice()]},
                        {"margin", vote.margin}});
    }
    json["judges"] = judges;
  }
  return line(json);
}

std::string error_json(const std::string& file, const std::string& error) {
  return line({{"file", file}, {"error", error}});
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
                {{"unfinite_points", facts.unfinite_points},
                 {"repeated_points", facts.repeated_points},
                 {"unused_vertices", facts.unused_vertices},
                 {"flat_triangles", facts.flat_triangles},
                 {"repeated_triangles", facts.repeated_triangles},
                 {"flipped_triangles", facts.flipped_triangles},
                 {"dust_triangles", facts.dust_triangles},
                 {"lone_points", facts.lone_points}}}});
}

std::string spin_json(const SpinResult& result) {
  return line({{"file", result.file},
               {"images", result.images},
               {"spin_points", result.spin_points},
               {"surface_points", result.surface_points},
               {"left_out", result.left_out},
               {"channels", result.shape.channels},
               {"rows", result.shape.rows},
               {"columns", result.shape.columns},
               {"bin_size", result.bin_size}});
}

std::string features_json(const std::string& file, std::size_t objects, std::size_t features, const Settings& settings,
                          const std::vector<SkippedObject>& left_out) {
  Json skipped = Json::array();
  for (const SkippedObject& object : left_out) {
    skipped.push_back({{"file", object.file.string()}, {"error", object.reason}});
  }
  return line({{"file", file},
               {"objects", objects},
               {"features", features},
               {"left_out", skipped},
               {"settings", settings_to_json(settings)}});
}

}  // namespace spincat
