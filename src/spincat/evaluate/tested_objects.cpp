#include "spincat/evaluate/tested_objects.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <utility>

#include "spincat/describe/describe_tasks.h"
#include "spincat/describe/packed_limits.h"
#include "spincat/describe/packed_matrix.h"
#include "spincat/describe/packed_settings.h"
#include "spincat/describe/rank_problems.h"
#include "spincat/error.h"
#include "spincat/evaluate/test_forms.h"
#include "spincat/geometry/random.h"
#include "spincat/io/read_object.h"
#include "spincat/parallel/farm_execution.h"
#include "spincat/parallel/packing.h"

namespace spincat {
namespace {

constexpr std::uint64_t kTestFormPurpose = 101;  // of derive_seed

}  // namespace

void fields(auto& archive, MessageOf<TestOptions> auto& options) {
  auto& [form, noise, cloud_points] = options;  // does not compile when a member is forgotten
  archive(form, noise, cloud_points);
}

std::span<const float> TestTable::features_of(std::uint32_t object, std::uint32_t view) const {
  const auto row = static_cast<Eigen::Index>(object) * rows_per_object + view;
  return {features.row(row).data(), static_cast<std::size_t>(features.cols())};
}

namespace {

void check_all_described(const TestTable& tested) {
  for (std::size_t i = 0; i < tested.objects.size(); ++i) {
    if (!tested.problems[i].empty()) {
      throw InputError(tested.objects[i].file.string(), tested.problems[i]);
    }
  }
}

// One object, in the form it is tested in.
struct TestedTask {
  std::uint64_t seed = 0;
  std::string file;
};

void fields(auto& archive, MessageOf<TestedTask> auto& task) {
  auto& [seed, file] = task;
  archive(seed, file);
}

// How objects are shown, read and described.
struct TestedContext {
  Settings settings;
  TestOptions options;
  ReadLimits limits;
  FeatureMatrix basis;  // without rows: none
};

void fields(auto& archive, MessageOf<TestedContext> auto& context) {
  auto& [settings, options, limits, basis] = context;
  archive(settings, options, limits, basis);
}

Described describe_task(const TestedTask& task, const TestedContext& context) {
  const Settings& settings = context.settings;
  const auto read = [&] {
    const Object object = read_listed_object(std::filesystem::path(task.file), context.limits);
    return in_test_form(object, context.options, task.seed);
  };
  Described described = describe_object(read, settings.tested_rows(), describe_copies(settings));
  if (context.basis.rows() > 0) {
    project(context.basis, described);
  }
  return described;
}

Work tested_work(TestedContext given) {
  const auto context = std::make_shared<const TestedContext>(std::move(given));
  return [context](std::string_view task) { return pack(describe_task(unpack<TestedTask>(task), *context)); };
}

}  // namespace

Work make_tested_work(std::string_view context) {
  return throwing_problems(tested_work(unpack<TestedContext>(context)));
}

TestTable describe_tested(std::span<const DatasetObject> objects, const FeatureMatrix& basis, Eigen::Index length,
                          const Settings& settings, const TestOptions& options, const Execution& execution) {
  const auto feature_length = static_cast<std::size_t>(length);
  const FarmExecution run(execution);
  TestTable table;
  table.objects.assign(objects.begin(), objects.end());
  table.rows_per_object = static_cast<std::uint32_t>(settings.tested_rows());
  table.features.setZero(static_cast<Eigen::Index>(objects.size() * table.rows_per_object),
                         static_cast<Eigen::Index>(feature_length));
  table.problems.resize(objects.size());
  const std::uint64_t stream = derive_seed(settings.seed, kTestFormPurpose);
  Job job;
  job.kind = kTestedTasks;
  const TestedContext context{settings, options, run.limits, basis};
  job.context = [&](Packer& packer) { packer(context); };
  job.work = tested_work(context);
  job.is_worth_keeping = has_no_problem;
  job.tasks = objects.size();
  job.task = [&](std::size_t i) { return pack(TestedTask{derive_seed(stream, i), objects[i].file.string()}); };
  job.deliver = [&](std::size_t i, const std::string& result) {
    check_finite(view_described(result), objects[i].file);
    const Described described = unpack_described(result);
    table.seconds += described.seconds;
    table.problems[i] = described.problem;
    if (described.lacks_memory) {
      throw RunError(objects[i].file.string(), described.problem);
    }
    if (described.features.empty()) {
      return;
    }
    table.kinds.add(described.kind);
    auto row = static_cast<Eigen::Index>(i * table.rows_per_object);
    for (const FeatureVector& found : described.features) {
      if (found.values.size() != feature_length) {
        table.problems[i] =
            fmt::format("gives {} features where the judges expect {}", found.values.size(), feature_length);
        return;
      }
      std::ranges::copy(found.values, table.features.row(row++).data());
    }
  };
  run.farm->run(job, run.ticking("describing test objects", objects.size()));
  if (run.strict) {
    check_all_described(table);
  }
  return table;
}

}  // namespace spincat
