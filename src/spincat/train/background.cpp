#include "spincat/train/background.h"

#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "spincat/background/background_shapes.h"
#include "spincat/describe/packed_matrix.h"
#include "spincat/describe/packed_settings.h"
#include "spincat/describe/rank_problems.h"
#include "spincat/describe/table_rows.h"
#include "spincat/error.h"
#include "spincat/parallel/packing.h"

namespace spincat {
namespace {

constexpr int kRows = 1;  // of each: itself

struct BackgroundContext {
  FeatureMatrix basis;  // without rows: none
  Settings settings;
};

void fields(auto& archive, MessageOf<BackgroundContext> auto& context) {
  auto& [basis, settings] = context;
  archive(basis, settings);
}

// Where training objects are shown as clouds, too, so are half of the shapes, an exact and a noisy one in turn: or else
// to be a cloud would mean to be known. The number of a training copy; 0: the shape itself.
int form_of(std::uint32_t number, const Settings& settings) {
  const std::uint32_t variant = number / kBackgroundFamilies % 4;
  if (settings.trained_for != TrainedFor::any || variant % 2 == 0) {
    return 0;
  }
  return settings.copies + (variant == 1 ? 1 : 2);
}

Work background_work(const Settings& settings, const FeatureBasis& basis) {
  return [settings, basis](std::string_view task) {
    const auto number = unpack<std::uint32_t>(task);
    const DescribeRow describe_row = describe_copies(settings);
    const auto in_its_form = [&](const Object& object, int, StageSeconds& seconds) {
      return describe_row(object, form_of(number, settings), seconds);
    };
    Described described = describe_object([&] { return Object(background_shape(number)); }, kRows, in_its_form);
    if (basis) {
      project(*basis, described);
    }
    return pack(described);
  };
}

// `described` gets the places of those that can be: a camera sees too little of some.
void describe_shapes(const Settings& settings, const FarmExecution& run, const FeatureBasis& basis, std::size_t first,
                     TableRows& rows, std::vector<std::uint32_t>& described) {
  Job job;
  job.kind = kBackgroundTasks;
  job.context = [&](Packer& packer) { packer(BackgroundContext{basis ? *basis : FeatureMatrix(), settings}); };
  job.work = background_work(settings, basis);
  job.is_worth_keeping = has_no_problem;
  job.tasks = static_cast<std::size_t>(settings.background);
  job.task = [](std::size_t i) { return pack(static_cast<std::uint32_t>(i)); };
  job.deliver = [&](std::size_t i, const std::string& result) {
    const PackedDescribed shape = view_described(result);
    if (shape.head.lacks_memory) {
      throw RunError("the background could not be described: " + shape.head.problem);
    }
    if (!shape.values.empty()) {
      rows.put(first + i, shape.values);
      described.push_back(static_cast<std::uint32_t>(first + i));
    }
  };
  run.farm->run(job, run.ticking("describing the background", job.tasks));
}

}  // namespace

Background describe_background(const Dataset& dataset, const Settings& settings, const FarmExecution& run,
                               const FeatureBasis& basis) {
  const std::size_t others = dataset.others.size();
  const auto shapes = static_cast<std::size_t>(settings.background);
  if (others + shapes == 0) {
    return {};
  }
  Background background;
  TableRows rows(others + shapes, kRows);
  std::vector<std::uint32_t> described;
  const auto file = [&](std::size_t i) -> const std::filesystem::path& { return dataset.others[i]; };
  const DescribeJob job{others, file, settings, kRows, run.split, dataset.limits, {}, basis};
  const auto keep = [&](std::size_t i, const Described& one, std::span<const FeatureBytes> values) {
    if (one.lacks_memory) {
      throw RunError(dataset.others[i].string(), one.problem);
    }
    if (run.strict && values.empty()) {
      throw InputError(dataset.others[i].string(), one.problem);
    }
    if (values.empty()) {
      background.skipped.push_back({dataset.others[i], one.problem});
    } else {
      rows.put(i, values);
      described.push_back(static_cast<std::uint32_t>(i));
    }
  };
  describe_files(*run.farm, job, keep, run.ticking("describing others", others));
  background.others = static_cast<std::uint32_t>(described.size());
  describe_shapes(settings, run, basis, others, rows, described);
  background.rows = rows.take(described);
  return background;
}

Work make_background_work(std::string_view context) {
  auto [basis, settings] = unpack<BackgroundContext>(context);
  const FeatureBasis shared = basis.rows() > 0 ? std::make_shared<const FeatureMatrix>(std::move(basis)) : nullptr;
  return throwing_problems(background_work(settings, shared));
}

}  // namespace spincat
