// What a model holds, for those inside the library.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "spincat/classify/model.h"
#include "spincat/describe/kinds.h"
#include "spincat/judge/judge_list.h"
#include "spincat/judge/known_judge.h"
#include "spincat/judge/platt_scaling.h"
#include "spincat/settings/settings.h"

namespace spincat {

// The members that Model has functions for are explained there.
struct ModelData {
  Settings settings;
  std::vector<std::string> categories;
  JudgeList judges;
  PlattScaling calibration;  // of the winner's weakest margin: how often it is right
  KnownJudge known;
  std::string dataset;
  std::vector<std::uint32_t> object_counts;
  KindCounts kinds;
  std::string made_by;
  std::filesystem::path file;

  std::size_t feature_length() const { return judges.feature_length(); }
};

}  // namespace spincat
