// An evaluation as JSON.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "spincat/report/json.h"
#include "spincat/report/report.h"
#include "spincat/settings/settings_json.h"

namespace spincat {
namespace {

using Json = nlohmann::ordered_json;

Evaluation two_categories() {
  Evaluation e;
  e.dataset = "furniture";
  e.categories = {"bed", "chair"};
  e.object_counts = {2, 3};
  e.list_checksum = "0123abcd";
  e.left_out = {{"lamp", "has 1 object"}};
  e.skipped = {{"x.off", "why"}};
  e.splits = 4;
  e.split_seeds = {7};
  e.mean_class_rate = {0.5, 0.1, {0.25, 0.75}};
  e.overall_rate = {0.25, 0.2, {0.125, 0.5}};
  e.category_rates = {{0.5, 0.0, {0.0, 1.0}}, {0.75, 0.0, {0.5, 1.0}}};
  e.seeds = {{7, e.mean_class_rate, e.overall_rate}};
  e.confusion = {{1, 2}, {3, 4}};
  e.seconds = {1, 2, 3, 4, 5};
  e.wall_seconds = 6;
  return e;
}

Json json_of(const Evaluation& e, const EvaluateOptions& options = {}) {
  const std::string line = evaluation_json(e, preset("paper"), options, {"spincat", "evaluate", "a b"});
  EXPECT_EQ(line.find('\n'), std::string::npos);
  return Json::parse(line);
}

TEST(EvaluationJson, ACategoryThatWasNeverTestedHasNoRate) {
  Evaluation e = two_categories();
  e.confusion = {{1, 2}, {0, 0}};
  EXPECT_EQ(json_of(e)["category_rates"]["chair"].dump(), R"({"rate":null,"interval":null})");
}

TEST(EvaluationJson, HasThePromisedKeys) {
  const Json json = json_of(two_categories());
  EXPECT_EQ(json["dataset"], "furniture");
  EXPECT_EQ(json["objects"], 5);
  EXPECT_EQ(json["categories"].dump(), R"(["bed","chair"])");
  EXPECT_EQ(json["splits"], 4);
  EXPECT_EQ(json["mean_class_rate"], 0.5);
  EXPECT_EQ(json["mean_class_rate_std"], 0.1);
  EXPECT_EQ(json["mean_class_rate_interval"].dump(), "[0.25,0.75]");
  EXPECT_EQ(json["overall_rate"], 0.25);
  EXPECT_EQ(json["overall_rate_std"], 0.2);
  EXPECT_EQ(json["overall_rate_interval"].dump(), "[0.125,0.5]");
  EXPECT_EQ(json["category_rates"].dump(),
            R"({"bed":{"rate":0.5,"interval":[0.0,1.0]},"chair":{"rate":0.75,"interval":[0.5,1.0]}})");
  EXPECT_EQ(
      json["seeds"].dump(),
      R"([{"seed":7,"mean_class_rate":0.5,"mean_class_rate_std":0.1,"overall_rate":0.25,"overall_rate_std":0.2}])");
  EXPECT_EQ(json["confusion"].dump(), "[[1,2],[3,4]]");
  EXPECT_EQ(json["seconds"], 6.0);
  EXPECT_EQ(json["object_counts"].dump(), R"({"bed":2,"chair":3})");
  EXPECT_EQ(json["stage_seconds"],
            (Json{{"read", 1.0}, {"prepare", 2.0}, {"spin", 3.0}, {"encode", 4.0}, {"judge", 5.0}}));
  EXPECT_EQ(json["settings"], settings_to_json(preset("paper")));
  EXPECT_EQ(json["left_out"].dump(), R"([{"category":"lamp","reason":"has 1 object"}])");
  EXPECT_EQ(json["skipped"].dump(), R"([{"file":"x.off","error":"why"}])");
  EXPECT_FALSE(json.contains("confidence"));
}

TEST(EvaluationJson, HasWhatIsNeededToRepeatTheRun) {
  Json run = json_of(two_categories())["run"];
  EXPECT_EQ(run["version"].get<std::string>().rfind("spincat ", 0), 0U);
  run.erase("version");
  EXPECT_EQ(run.dump(),
            R"({"command":["spincat","evaluate","a b"],"protocol":"splits","test_share":0.2,"split_seeds":[7],)"
            R"("test_as":"as-is","list_checksum":"0123abcd"})");
}

TEST(EvaluationJson, OfAnotherDataSetNamesBoth) {
  Evaluation e = two_categories();
  e.protocol = Protocol::across;
  e.test_dataset = "other";
  e.test_object_counts = {4, 5};
  e.test_list_checksum = "76543210";
  EvaluateOptions options;
  options.test.form = TestForm::cloud;
  const Json run = json_of(e, options)["run"];
  EXPECT_EQ(run["protocol"], "across");
  EXPECT_EQ(run["test_dataset"], "other");
  EXPECT_EQ(run["test_objects"], 9);
  EXPECT_EQ(run["test_object_counts"].dump(), R"({"bed":4,"chair":5})");
  EXPECT_EQ(run["test_list_checksum"], "76543210");
  EXPECT_EQ(run["test_as"], "cloud");
  EXPECT_EQ(run["noise"], 0.01);
  EXPECT_EQ(run["cloud_points"], 2048);
  EXPECT_FALSE(run.contains("test_share"));
  EXPECT_FALSE(run.contains("split_seeds"));
}

TEST(EvaluationJson, TellsWhatTheConfidenceTells) {
  Evaluation e = two_categories();
  e.confidence = ConfidenceMeasure{0.875, 0.75, 0.5, 0, 0.25, 0.625};
  EXPECT_EQ(json_of(e)["confidence"].dump(), R"({"mean":0.5,"right_or_wrong_auc":0.875,"turned_away":0.25})");
  e.confidence->unknown_objects = 7;
  EXPECT_EQ(
      json_of(e)["confidence"].dump(),
      R"({"mean":0.5,"right_or_wrong_auc":0.875,"turned_away":0.25,"known_or_unknown_auc":0.75,"unknown_objects":7,)"
      R"("unknown_objects_turned_away":0.625})");
}

TEST(EvaluationJson, OfNothingIsEmptyLists) {
  EXPECT_EQ(json_of({})["skipped"].dump(), "[]");
  EXPECT_EQ(json_of({})["left_out"].dump(), "[]");
  EXPECT_EQ(json_of({})["seeds"].dump(), "[]");
  EXPECT_EQ(json_of({})["object_counts"].dump(), "{}");
}

}  // namespace
}  // namespace spincat
