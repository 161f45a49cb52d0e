#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "harness.h"
#include "sections.h"
#include "spincat/describe/describe.h"
#include "spincat/geometry/random.h"
#include "spincat/io/read_object.h"
#include "spincat/judge/judge_list.h"

namespace spincat::bench {
namespace {

// Presets, and the paper's over points drawn from the faces instead of the vertices.
std::map<std::string, Settings> recipes() {
  Settings samples = preset("paper");
  samples.prepare.surface = SurfaceKind::samples;
  return {{"default", preset("default")}, {"paper, 2048 samples", samples}, {"paper", preset("paper")}};
}

// Judges of six categories: what they have learned does not change how long they take.
JudgeList six_categories(std::size_t feature_length) {
  constexpr std::uint32_t kCategories = 6;
  Random random(3);
  const auto count = static_cast<Eigen::Index>(all_pairs(kCategories).size());
  JudgeList judges;
  judges.categories = kCategories;
  judges.weights.resize(count, static_cast<Eigen::Index>(feature_length));
  for (Eigen::Index i = 0; i < judges.weights.size(); ++i) {
    judges.weights.data()[i] = static_cast<float>(random.uniform(-1.0, 1.0));
  }
  judges.bias.setZero(count);
  judges.support_vectors.assign(static_cast<std::size_t>(count), 1);
  return judges;
}

// Milliseconds by stage for one object.
std::map<std::string, double> time_object(const Object& object, const Settings& settings) {
  StageSeconds spent;
  const FeatureVector features = describe(object, settings, points_seed(settings), &spent);
  const JudgeList judges = six_categories(features.values.size());
  const double start = seconds(CLOCK_MONOTONIC);
  judges.vote(features.values);
  spent.judge = seconds(CLOCK_MONOTONIC) - start;
  std::map<std::string, double> stages = {
      {"prepare", spent.prepare}, {"spin", spent.spin}, {"encode", spent.encode}, {"judge", spent.judge}};
  for (auto& [stage, time] : stages) {
    time *= 1e3;
  }
  stages["total"] = stages["prepare"] + stages["spin"] + stages["encode"] + stages["judge"];
  return stages;
}

std::vector<std::filesystem::path> object_files(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file() && is_object_file(entry.path())) {
      files.push_back(entry.path());
    }
  }
  std::ranges::sort(files);
  return files;
}

}  // namespace

nlohmann::ordered_json stage_times(const std::filesystem::path& folder, int rounds) {
  std::vector<Object> objects;
  std::vector<double> read;
  for (const auto& file : object_files(folder)) {
    const double start = seconds(CLOCK_PROCESS_CPUTIME_ID);
    objects.push_back(read_object(file));
    read.push_back(1e3 * (seconds(CLOCK_PROCESS_CPUTIME_ID) - start));
  }
  nlohmann::ordered_json result = {{"objects", objects.size()}, {"read", Timing::median(read)}};
  for (const auto& [name, settings] : recipes()) {
    // Of each object the best round; of the objects the median.
    std::map<std::string, std::vector<double>> stages;
    for (const Object& object : objects) {
      std::map<std::string, double> best = time_object(object, settings);
      for (int round = 1; round < rounds; ++round) {
        best = std::min(best, time_object(object, settings),
                        [](const auto& a, const auto& b) { return a.at("total") < b.at("total"); });
      }
      for (const auto& [stage, time] : best) {
        stages[stage].push_back(time);
      }
    }
    for (const auto& [stage, times] : stages) {
      result[name][stage] = Timing::median(times);
    }
  }
  return result;
}

}  // namespace spincat::bench
