#include "spincat/report/sweep_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "spincat/report/csv_field.h"
#include "spincat/report/json_parts.h"
#include "spincat/report/report.h"
#include "spincat/report/text.h"
#include "spincat/report/text_table.h"
#include "spincat/settings/setting_table.h"
#include "spincat/settings/settings_json.h"
#include "spincat/version.h"

namespace spincat {
namespace {

std::string rate_fields(const Rate& rate) {
  return fmt::format("{},{},{},{}", rate.mean, rate.deviation, rate.interval.low, rate.interval.high);
}

// The setting as settings_to_json calls it, however the user spelled it.
std::string key_of(const Variation& variation) {
  return std::string(find_setting(variation.setting).name);
}

Json point_json(const Sweep& sweep, const SweepPoint& point) {
  Json json = Json::object();
  for (std::size_t v = 0; v < sweep.variations.size(); ++v) {
    json[key_of(sweep.variations[v])] = point.values[v];
  }
  return {{"values", json},
          {"mean_class_rate", point.mean_class_rate.mean},
          {"mean_class_rate_std", point.mean_class_rate.deviation},
          {"mean_class_rate_interval", {point.mean_class_rate.interval.low, point.mean_class_rate.interval.high}},
          {"overall_rate", point.overall_rate.mean},
          {"overall_rate_std", point.overall_rate.deviation},
          {"overall_rate_interval", {point.overall_rate.interval.low, point.overall_rate.interval.high}},
          {"stage_seconds", stage_seconds(point.seconds)}};
}

}  // namespace

namespace {

enum class Times { by_stage, together };

TextTable sweep_table(const Sweep& sweep, Times times) {
  const std::vector<const char*> stages =
      times == Times::by_stage ? std::vector{"read", "prepare", "spin", "encode", "judge"} : std::vector{"time"};
  TextTable table(std::vector<Align>(sweep.variations.size() + 2 + stages.size(), Align::right));
  std::vector<Cell> head;
  for (const Variation& variation : sweep.variations) {
    head.emplace_back(printable(variation.setting));
  }
  head.insert(head.end(), {"mean-class rate", "overall rate"});
  head.insert(head.end(), stages.begin(), stages.end());
  table.add(std::move(head));
  for (const SweepPoint& point : sweep.points) {
    std::vector<Cell> row;
    for (const std::string& value : point.values) {
      row.emplace_back(printable(value));
    }
    row.emplace_back(fmt::format("{:.3f} ± {:.3f}", point.mean_class_rate.mean, point.mean_class_rate.deviation));
    row.emplace_back(fmt::format("{:.3f} ± {:.3f}", point.overall_rate.mean, point.overall_rate.deviation));
    const StageSeconds& s = point.seconds;
    const std::vector<double> seconds = times == Times::by_stage
                                            ? std::vector{s.read, s.prepare, s.spin, s.encode, s.judge}
                                            : std::vector{s.read + s.prepare + s.spin + s.encode + s.judge};
    for (const double each : seconds) {
      row.emplace_back(human_seconds(each));
    }
    table.add(std::move(row));
  }
  return table;
}

}  // namespace

std::string sweep_text(const Sweep& sweep, std::size_t width) {
  const std::string whole = sweep_table(sweep, Times::by_stage).str();
  return widest_line(whole) <= width ? whole : sweep_table(sweep, Times::together).str();
}

std::string sweep_json(const Sweep& sweep, const Settings& settings, const EvaluateOptions& options,
                       const std::vector<std::string>& command) {
  Json vary = Json::object();
  for (const Variation& variation : sweep.variations) {
    vary[key_of(variation)] = variation.values;
  }
  Json points = Json::array();
  for (const SweepPoint& point : sweep.points) {
    points.push_back(point_json(sweep, point));
  }
  Json others = settings_to_json(settings);
  for (const Variation& variation : sweep.variations) {
    others.erase(key_of(variation));
  }
  const std::vector<std::uint64_t> seeds =
      options.split_seeds.empty() ? std::vector{settings.seed} : options.split_seeds;
  return line({{"dataset", sweep.dataset},
               {"objects", sweep.objects},
               {"vary", vary},
               {"points", points},
               {"run",
                {{"command", command},
                 {"version", kProgram},
                 {"protocol", options.leave_one_out ? "leave-one-out" : "splits"},
                 {"splits", options.splits},
                 {"test_share", options.test_share},
                 {"split_seeds", seeds},
                 {"list_checksum", sweep.list_checksum}}},
               {"settings", others}});
}

std::string sweep_csv(const Sweep& sweep) {
  std::string csv;
  for (const Variation& variation : sweep.variations) {
    csv += csv_field(key_of(variation)) + ",";
  }
  for (const char* rate : {"mean_class_rate", "overall_rate"}) {
    csv += fmt::format("{0},{0}_std,{0}_low,{0}_high,", rate);
  }
  csv += "read_seconds,prepare_seconds,spin_seconds,encode_seconds,judge_seconds\n";
  for (const SweepPoint& point : sweep.points) {
    for (const std::string& value : point.values) {
      csv += csv_field(value) + ",";
    }
    const StageSeconds& s = point.seconds;
    csv += fmt::format("{},{},{},{},{},{},{}\n", rate_fields(point.mean_class_rate), rate_fields(point.overall_rate),
                       s.read, s.prepare, s.spin, s.encode, s.judge);
  }
  return csv;
}

}  // namespace spincat
