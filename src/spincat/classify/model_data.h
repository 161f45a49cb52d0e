// What a model holds, for those inside the library.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "spincat/classify/model.h"
#include "spincat/describe/kinds.h"
#include "spincat/judge/calibration.h"
#include "spincat/judge/familiarity.h"
#include "spincat/judge/judge_list.h"
#include "spincat/settings/settings.h"

namespace spincat {

// The members that Model has functions for are explained there.
struct ModelData {
  Settings settings;
  std::vector<std::string> categories;
  JudgeList judges;
  Calibration calibration;
  Familiarity familiarity;
  std::string dataset;
  std::vector<std::uint32_t> object_counts;
  KindCounts kinds;
  std::string made_by;
  std::filesystem::path file;

  std::size_t feature_length() const { return judges.feature_length(); }
};

}  // namespace spincat
