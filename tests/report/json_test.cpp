#include "spincat/report/json.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "spincat/classify/model_data.h"
#include "spincat/report/report.h"
#include "spincat/settings/settings_json.h"

namespace spincat {
namespace {

using Json = nlohmann::ordered_json;
using Keys = std::vector<std::string>;

// The object that one line holds.
Json parsed(const std::string& line) {
  EXPECT_EQ(line.find('\n'), std::string::npos);
  return Json::parse(line);
}

Keys keys_of(const Json& json) {
  Keys keys;
  for (const auto& [key, value] : json.items()) {
    keys.push_back(key);
  }
  return keys;
}

ModelData two_categories() {
  ModelData model;
  model.settings = preset("paper");
  model.categories = {"bed", "chair \"x\""};
  model.object_counts = {9, 69};
  model.judges.weights.resize(1, 12);
  model.judges.support_vectors = {7};
  model.made_by = "spincat 0.1.0";
  model.dataset = "furniture";
  return model;
}

Classification chair() {
  Classification c;
  c.ballot = count_votes(2, std::vector<float>{-0.5F});
  c.confidence = 0.75;
  c.known = 0.875;
  c.seconds = {0.001, 0.002, 0.003, 0.004, 0.005};
  return c;
}

TEST(ClassificationJson, HasThePromisedKeys) {
  const Json json = parsed(classification_json("a.obj", chair(), two_categories(), false));
  EXPECT_EQ(keys_of(json), (Keys{"file", "category", "confidence", "known", "votes", "milliseconds"}));
  EXPECT_EQ(json["file"], "a.obj");
  EXPECT_EQ(json["category"], "chair \"x\"");
  EXPECT_EQ(json["confidence"], 0.75);
  EXPECT_EQ(json["known"], 0.875);
  EXPECT_EQ(json["votes"], (Json{{"bed", 0}, {"chair \"x\"", 1}}));
  EXPECT_NEAR(json["milliseconds"].get<double>(), 15.0, 1e-9);
}

TEST(ClassificationJson, TellsEveryJudgesWord) {
  const Json json = parsed(classification_json("a.obj", chair(), two_categories(), true));
  EXPECT_EQ(keys_of(json), (Keys{"file", "category", "confidence", "known", "votes", "milliseconds", "judges"}));
  ASSERT_EQ(json["judges"].size(), 1U);
  EXPECT_EQ(json["judges"][0], (Json{{"a", "bed"}, {"b", "chair \"x\""}, {"vote", "chair \"x\""}, {"margin", -0.5}}));
}

TEST(ClassificationJson, SaysWhereTheJudgesWereNotTrainedForTheObject) {
  Classification classification = chair();
  classification.kind_mismatch = "is a point cloud";
  EXPECT_EQ(parsed(classification_json("a.obj", classification, two_categories(), false))["kind_mismatch"],
            "is a point cloud");
}

TEST(ClassificationJson, OfARejectedNameIsUnknown) {
  const Json json = parsed(classification_json("a.obj", chair(), two_categories(), false, true));
  EXPECT_EQ(keys_of(json), (Keys{"file", "category", "confidence", "known", "votes", "milliseconds", "best_guess"}));
  EXPECT_EQ(json["category"], "unknown");
  EXPECT_EQ(json["best_guess"], "chair \"x\"");
}

TEST(ErrorJson, HasThePromisedKeys) {
  const Json json = parsed(error_json("a \"b\"\\\n.obj", "line 3: bad"));
  EXPECT_EQ(keys_of(json), (Keys{"file", "error"}));
  EXPECT_EQ(json["file"], "a \"b\"\\\n.obj");
  EXPECT_EQ(json["error"], "line 3: bad");
}

TEST(ErrorJson, ReplacesWhatIsNoUtf8) {
  EXPECT_EQ(parsed(error_json("caf\xE9.obj", "\xFF"))["file"], "caf\xEF\xBF\xBD.obj");
}

TEST(ModelJson, HasThePromisedKeys) {
  const Json json = parsed(model_json("m.spincat", two_categories()));
  EXPECT_EQ(keys_of(json), (Keys{"file", "kind", "made_by", "dataset", "categories", "object_counts", "features",
                                 "judges", "settings"}));
  EXPECT_EQ(json["kind"], "model");
  EXPECT_EQ(json["categories"], Json(two_categories().categories));
  EXPECT_EQ(json["object_counts"].dump(), R"({"bed":9,"chair \"x\"":69})");  // as evaluation_json has them
  EXPECT_EQ(json["features"], 12);
  EXPECT_EQ(json["judges"], 1);
}

TEST(TrainingJson, IsThatOfTheModelWithWhatWasSkipped) {
  const TrainResult result{two_categories(), {{"x.off", "why"}}, {1, 2, 3, 4, 5}};
  const Json json = parsed(training_json("m.spincat", result));
  Keys keys = keys_of(parsed(model_json("m.spincat", two_categories())));
  keys.insert(keys.end(), {"stage_seconds", "skipped"});
  EXPECT_EQ(keys_of(json), keys);
  EXPECT_EQ(json["skipped"].dump(), R"([{"file":"x.off","error":"why"}])");
  EXPECT_EQ(json["stage_seconds"]["judge"], 5.0);
}

TEST(ObjectJson, HasThePromisedKeys) {
  ObjectFacts facts;
  facts.is_mesh = true;
  facts.points = 8;
  facts.triangles = 12;
  facts.low = Vec3(1, 1, 1);
  facts.high = Vec3(2, 3, 4);
  facts.area = 22;
  facts.resolution = 2;
  facts.unused_vertices = 5;
  const Json json = parsed(object_json("a.off", facts));
  EXPECT_EQ(keys_of(json), (Keys{"file", "kind", "points", "triangles", "size", "area", "resolution", "defects"}));
  EXPECT_EQ(json["kind"], "mesh");
  EXPECT_EQ(json["size"].dump(), "[1.0,2.0,3.0]");
  EXPECT_EQ(
      json["defects"].dump(),
      R"({"unfinite_points":0,"repeated_points":0,"unused_vertices":5,"flat_triangles":0,"repeated_triangles":0,"flipped_triangles":0,"dust_triangles":0,"lone_points":0})");
  facts.is_mesh = false;
  EXPECT_EQ(parsed(object_json("a.off", facts))["kind"], "point cloud");
}

}  // namespace
}  // namespace spincat
