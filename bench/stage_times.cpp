#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "harness.h"
#include "sections.h"
#include "spincat/encode/encoding.h"
#include "spincat/io/read_object.h"
#include "spincat/prepare/prepare.h"
#include "spincat/spin/spin_images.h"

namespace spincat::bench {
namespace {

struct Recipe {
  std::string name;
  PrepareSettings prepare;
  SpinImageParams spin;
  std::string encoding;
};

std::vector<Recipe> recipes() {
  Recipe best{"default", {}, {}, "pooled-pyramid"};
  best.spin.image_width = 40;
  best.spin.bin_size = 0.05;
  best.spin.binning = Binning::nearest;
  best.spin.angle_test = AngleTest::soft;
  Recipe paper{"paper, 2048 samples", {}, {}, "concatenation"};
  paper.prepare.surface = SurfaceKind::samples;
  paper.prepare.spin_points = 100;
  paper.spin.image_width = 20;
  paper.spin.bin_size = 0.1;
  Recipe vertices = paper;
  vertices.name = "paper, vertices";
  vertices.prepare.surface = SurfaceKind::vertices;
  return {best, paper, vertices};
}

// Milliseconds of CPU by stage for one object.
std::map<std::string, double> time_object(const Object& object, const Recipe& recipe) {
  std::map<std::string, double> stages;
  double last = seconds(CLOCK_PROCESS_CPUTIME_ID);
  const auto stamp = [&](const std::string& stage) {
    const double now = seconds(CLOCK_PROCESS_CPUTIME_ID);
    stages[stage] = 1e3 * (now - last);
    stages["total"] += stages[stage];
    last = now;
  };
  const PreparedObject prepared = prepare(object, recipe.prepare, 1);
  stamp("prepare");
  const std::unique_ptr<Encoding> encoding = make_encoding(recipe.encoding);
  const auto sums = encoding->begin(prepared.surface, prepared.spin_points, recipe.spin);
  std::vector<double> values(sums->size(), 0.0);
  stamp("encode");
  double encode = stages["encode"];
  make_spin_images(prepared.surface, prepared.spin_points, recipe.spin, [&](const SpinImageBlock& block) {
    const double before = seconds(CLOCK_PROCESS_CPUTIME_ID);
    sums->accumulate(block, values);
    encode += 1e3 * (seconds(CLOCK_PROCESS_CPUTIME_ID) - before);
  });
  stamp("spin");
  stages["spin"] -= encode - stages["encode"];
  sums->finish(values);
  stamp("finish");
  stages["encode"] = encode + stages["finish"];
  stages.erase("finish");
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
  for (const Recipe& recipe : recipes()) {
    // Of each object the best round; of the objects the median.
    std::map<std::string, std::vector<double>> stages;
    for (const Object& object : objects) {
      std::map<std::string, double> best = time_object(object, recipe);
      for (int round = 1; round < rounds; ++round) {
        const std::map<std::string, double> again = time_object(object, recipe);
        if (again.at("total") < best.at("total")) {
          best = again;
        }
      }
      for (const auto& [stage, time] : best) {
        stages[stage].push_back(time);
      }
    }
    for (const auto& [stage, times] : stages) {
      result[recipe.name][stage] = Timing::median(times);
    }
  }
  return result;
}

}  // namespace spincat::bench
