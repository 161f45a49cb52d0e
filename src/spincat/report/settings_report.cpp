#include "spincat/report/settings_report.h"

#include <fmt/format.h>

#include "spincat/report/json_parts.h"
#include "spincat/report/text_table.h"
#include "spincat/settings/setting_table.h"
#include "spincat/settings/settings_json.h"

namespace spincat {
namespace {

constexpr const char* kStageNames[] = {"points", "images", "features", "training"};

std::string values_text(const Setting& setting) {
  if (std::string words = setting_words(setting); !words.empty()) {
    return words;
  }
  Settings any;
  if (std::holds_alternative<bool*>(setting.member(any))) {
    return "true, false";
  }
  return std::holds_alternative<std::uint64_t*>(setting.member(any)) ? "a whole number from 0" : setting.range.text();
}

}  // namespace

std::string settings_list_text(std::size_t width) {
  std::vector<Cell> head = {"setting", "values"};
  std::vector<Align> align = {Align::left, Align::left};
  for (const std::string& name : preset_names()) {
    head.emplace_back(name);
    align.push_back(Align::left);
  }
  TextTable table(align);
  table.add(std::move(head));
  for (const Setting& setting : setting_table()) {
    std::vector<Cell> row = {std::string(setting.name), values_text(setting)};
    for (const std::string& name : preset_names()) {
      row.emplace_back(setting_text(preset(name), setting));
    }
    table.add(std::move(row));
  }
  std::string text = table.str() + "\n";
  for (const Setting& setting : setting_table()) {
    constexpr std::size_t kName = 16;
    const std::string line = fmt::format("{:<{}}{}", setting.name, kName, setting.help);
    text += (width > 0 ? wrapped(line, width, kName) : line) + "\n";
  }
  return text;
}

std::string settings_list_json() {
  Json list = Json::array();
  for (const Setting& setting : setting_table()) {
    const std::string name(setting.name);
    Json row = {{"name", name},
                {"option", fmt::format("--{}", setting.option)},
                {"stage", kStageNames[static_cast<std::size_t>(setting.stage)]},
                {"help", setting.help},
                {"values", values_text(setting)}};
    for (const std::string& each : preset_names()) {
      row["defaults"][each] = settings_to_json(preset(each))[name];
    }
    list.push_back(std::move(row));
  }
  return Json{{"settings", list}}.dump();
}

}  // namespace spincat
