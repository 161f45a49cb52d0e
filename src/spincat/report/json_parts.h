// Pieces that several JSON reports have in common.
#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "spincat/dataset/dataset.h"
#include "spincat/describe/describe.h"

namespace spincat {

using Json = nlohmann::ordered_json;

inline std::string line(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

inline Json stage_seconds(const StageSeconds& seconds) {
  return {{"read", seconds.read},
          {"prepare", seconds.prepare},
          {"spin", seconds.spin},
          {"encode", seconds.encode},
          {"judge", seconds.judge}};
}

inline Json skipped_objects(const std::vector<SkippedObject>& skipped) {
  Json list = Json::array();
  for (const SkippedObject& each : skipped) {
    list.push_back({{"file", each.file.string()}, {"error", each.reason}});
  }
  return list;
}

inline Json by_category(const std::vector<std::string>& categories, const std::vector<std::uint32_t>& counts) {
  Json json = Json::object();
  for (std::size_t c = 0; c < categories.size(); ++c) {
    json[categories[c]] = counts[c];
  }
  return json;
}

}  // namespace spincat
