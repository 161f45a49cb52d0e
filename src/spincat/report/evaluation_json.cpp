#include <algorithm>
#include <nlohmann/json.hpp>
#include <numeric>

#include "spincat/report/json.h"
#include "spincat/report/json_parts.h"
#include "spincat/report/report.h"
#include "spincat/settings/settings_json.h"
#include "spincat/version.h"

namespace spincat {
namespace {

std::size_t sum(const std::vector<std::uint32_t>& counts) {
  return std::accumulate(counts.begin(), counts.end(), std::size_t{0});
}

Json bounds(const Interval& interval) {
  return {interval.low, interval.high};
}

const char* protocol_name(Protocol protocol) {
  switch (protocol) {
    case Protocol::leave_one_out:
      return "leave-one-out";
    case Protocol::across:
      return "across";
    case Protocol::splits:
      break;
  }
  return "splits";
}

Json category_rates(const Evaluation& e) {
  Json json = Json::object();
  for (std::size_t c = 0; c < e.category_rates.size(); ++c) {
    const std::vector<std::uint32_t>& row = e.confusion[c];
    const bool is_tested = std::ranges::any_of(row, [](std::uint32_t count) { return count > 0; });
    json[e.categories[c]] = {{"rate", is_tested ? Json(e.category_rates[c].mean) : Json()},
                             {"interval", is_tested ? bounds(e.category_rates[c].interval) : Json()}};
  }
  return json;
}

Json seed_rates(const std::vector<SeedRates>& seeds) {
  Json list = Json::array();
  for (const SeedRates& each : seeds) {
    list.push_back({{"seed", each.seed},
                    {"mean_class_rate", each.mean_class_rate.mean},
                    {"mean_class_rate_std", each.mean_class_rate.deviation},
                    {"overall_rate", each.overall_rate.mean},
                    {"overall_rate_std", each.overall_rate.deviation}});
  }
  return list;
}

Json left_out(const std::vector<LeftOutCategory>& categories) {
  Json list = Json::array();
  for (const LeftOutCategory& each : categories) {
    list.push_back({{"category", each.name}, {"reason", each.reason}});
  }
  return list;
}

Json confidence(const ConfidenceMeasure& measure) {
  Json json = {{"mean", measure.mean_confidence},
               {"right_or_wrong_auc", measure.right_or_wrong},
               {"turned_away", measure.turned_away}};
  if (measure.unknown_objects > 0) {
    json["known_or_unknown_auc"] = measure.known_or_unknown;
    json["unknown_objects"] = measure.unknown_objects;
    json["unknown_objects_turned_away"] = measure.strangers_turned_away;
  }
  return json;
}

// What is needed to repeat the run, beside the settings.
Json run_of(const Evaluation& e, const EvaluateOptions& options, const std::vector<std::string>& command) {
  Json json = {{"command", command},
               {"version", kProgram},
               {"protocol", protocol_name(e.protocol)},
               {"test_share", options.test_share},
               {"split_seeds", e.split_seeds},
               {"test_as", name_of(options.test.form)},
               {"list_checksum", e.list_checksum}};
  if (options.test.has_noise()) {
    json["noise"] = options.test.used_noise();
  }
  if (options.test.has_cloud_points()) {
    json["cloud_points"] = options.test.used_cloud_points();
  }
  if (e.protocol != Protocol::splits) {
    json.erase("test_share");
    json.erase("split_seeds");
  }
  if (e.protocol == Protocol::across) {
    json["test_dataset"] = e.test_dataset;
    json["test_objects"] = sum(e.test_object_counts);
    json["test_object_counts"] = by_category(e.categories, e.test_object_counts);
    json["test_list_checksum"] = e.test_list_checksum;
  }
  return json;
}

}  // namespace

std::string evaluation_json(const Evaluation& e, const Settings& settings, const EvaluateOptions& options,
                            const std::vector<std::string>& command) {
  Json json = {{"dataset", e.dataset},
               {"objects", sum(e.object_counts)},
               {"categories", e.categories},
               {"splits", e.splits},
               {"mean_class_rate", e.mean_class_rate.mean},
               {"mean_class_rate_std", e.mean_class_rate.deviation},
               {"mean_class_rate_interval", bounds(e.mean_class_rate.interval)},
               {"overall_rate", e.overall_rate.mean},
               {"overall_rate_std", e.overall_rate.deviation},
               {"overall_rate_interval", bounds(e.overall_rate.interval)},
               {"category_rates", category_rates(e)},
               {"seeds", seed_rates(e.seeds)},
               {"confusion", e.confusion},
               {"seconds", e.wall_seconds},
               {"object_counts", by_category(e.categories, e.object_counts)},
               {"stage_seconds", stage_seconds(e.seconds)},
               {"run", run_of(e, options, command)},
               {"settings", settings_to_json(settings)},
               {"left_out", left_out(e.left_out)},
               {"skipped", skipped_objects(e.skipped)}};
  for (const ViewsRates& of : e.views) {
    json["views"].push_back(
        {{"views", of.views}, {"mean_class_rate", of.mean_class_rate}, {"overall_rate", of.overall_rate}});
  }
  if (e.confidence) {
    json["confidence"] = confidence(*e.confidence);
  }
  return line(json);
}

}  // namespace spincat
