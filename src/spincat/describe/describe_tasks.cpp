#include "spincat/describe/describe_tasks.h"

#include <fmt/format.h>

#include <algorithm>
#include <new>
#include <optional>
#include <utility>

#include "spincat/describe/packed_features.h"
#include "spincat/describe/packed_limits.h"
#include "spincat/describe/packed_matrix.h"
#include "spincat/describe/packed_settings.h"
#include "spincat/describe/rank_problems.h"
#include "spincat/describe/stopwatch.h"
#include "spincat/describe/training_copies.h"
#include "spincat/encode/encoding.h"
#include "spincat/error.h"
#include "spincat/io/read_object.h"
#include "spincat/judge/fixed_product.h"

namespace spincat {
namespace {

// What all tasks need.
struct DescribeContext {
  int views = 1;
  std::uint64_t rows_to_keep = 0;  // of so many objects; 0: none
  FeatureMatrix basis;             // without rows: none
  ReadLimits limits;
  Settings settings;
};

void fields(auto& archive, MessageOf<DescribeContext> auto& context) {
  auto& [views, rows_to_keep, basis, limits, settings] = context;
  archive(views, rows_to_keep, basis, limits, settings);
}

// From so many spin points on, an object is spread over ranks by itself.
constexpr int kDenseSpinPoints = 8 * static_cast<int>(kSpinImageBlock * 8);

Work describe_work(const Settings& settings, int rows, const FeatureBasis& basis, const ReadLimits& limits) {
  return [settings, rows, basis, limits](std::string_view file) {
    Described described =
        describe_object([&] { return read_listed_object(file, limits); }, rows, describe_copies(settings));
    if (basis) {
      project(*basis, described);
    }
    return pack(described);
  };
}

// Objects one after the other: rank 0 prepares, the spin points are spread over ranks.
void describe_by_points(TaskFarm& farm, const DescribeJob& job, const DeliverDescribed& deliver,
                        const TaskFarm::Tick& tick) {
  std::size_t done = 0;
  const auto at_work = [&](std::size_t) {
    if (tick) {
      tick(done);
    }
  };
  const EncodePrepared encoder = encode_on(farm, job.settings, job.split, at_work);
  for (std::size_t i = 0; i < job.files; ++i) {
    Described one = describe_object([&] { return read_listed_object(job.file(i), job.limits); }, job.views,
                                    describe_copies(job.settings, encoder));
    if (job.basis) {
      project(*job.basis, one);
    }
    std::vector<std::vector<float>> numbers;
    std::vector<FeatureBytes> values;
    for (FeatureVector& features : one.features) {
      numbers.push_back(std::exchange(features.values, {}));
      values.emplace_back(std::span<const float>(numbers.back()));
    }
    deliver(i, one, values);
    ++done;
    at_work(0);
  }
}

}  // namespace

void project(const FeatureMatrix& basis, Described& described) {
  FeatureMatrix rows(static_cast<Eigen::Index>(described.features.size()), basis.cols());
  for (std::size_t i = 0; i < described.features.size(); ++i) {
    const std::vector<float>& values = described.features[i].values;
    if (static_cast<Eigen::Index>(values.size()) != basis.cols()) {
      described.problem = fmt::format("gives {} features where others give {}", values.size(), basis.cols());
      described.features.clear();
      return;
    }
    std::ranges::copy(values, rows.row(static_cast<Eigen::Index>(i)).data());
  }
  const FeatureMatrix coordinates = product_with_transposed<float>(rows, basis);
  for (std::size_t i = 0; i < described.features.size(); ++i) {
    const auto row = coordinates.row(static_cast<Eigen::Index>(i));
    described.features[i].values.assign(row.begin(), row.end());
    described.features[i].blocks = {static_cast<std::uint32_t>(coordinates.cols())};
  }
}

DescribeRow describe_copies(const Settings& settings, const EncodePrepared& encoder) {
  return [&settings, encoder](const Object& object, int row, StageSeconds& seconds) {
    if (row == 0 && settings.trained_for != TrainedFor::views) {  // without copying it
      return describe(object, settings, points_seed(settings), &seconds, encoder);
    }
    Stopwatch watch;
    const auto [copy, seed] = training_copy(object, settings, row);
    seconds.prepare += watch.lap();
    return describe(copy, settings, seed, &seconds, encoder);
  };
}

Described describe_object(const std::function<Object()>& read, int rows, const DescribeRow& describe_row) {
  Described result;
  const auto refuse = [&](const std::string& problem, bool lacks_memory) {
    result.features.clear();
    result.problem = problem;
    result.lacks_memory = lacks_memory;
  };
  bool is_read = false;
  try {
    Stopwatch watch;
    const Object object = read();
    is_read = true;
    result.kind = kind_of(object);
    result.seconds.read = watch.lap();
    for (int row = 0; row < rows; ++row) {
      result.features.push_back(describe_row(object, row, result.seconds));
    }
  } catch (const InputError& error) {
    refuse(error.problem(), false);
  } catch (const RunError& error) {
    if (is_read) {  // that of a farm
      throw;
    }
    refuse(error.problem(), true);
  } catch (const std::bad_alloc&) {
    refuse("not enough memory for it", true);
  }
  return result;
}

// All but the feature vectors, which follow.
void fields(auto& archive, MessageOf<Described> auto& described) {
  auto& [features, problem, lacks_memory, kind, seconds] = described;  // does not compile when a member is forgotten
  static_cast<void>(features);
  archive(problem, lacks_memory, kind, seconds);
}

std::string pack(const Described& described) {
  constexpr std::size_t kBesidesValues = 200;  // of a feature vector with a few blocks
  std::size_t size = described.problem.size() + kBesidesValues;
  for (const FeatureVector& features : described.features) {
    size += features.values.size() * sizeof(float) + kBesidesValues;
  }
  Packer packer;
  packer.reserve(size);
  packer(described);
  for (const FeatureVector& features : described.features) {
    pack_features(packer, features);
  }
  return packer.take();
}

void check_finite(const PackedDescribed& described, const std::filesystem::path& file) {
  if (!std::ranges::all_of(described.values, &FeatureBytes::are_finite)) {
    throw RunError(file.string(), "its features came damaged from a journal or another rank: one is not finite");
  }
}

PackedDescribed view_described(std::string_view bytes) {
  Unpacker fields(bytes);
  PackedDescribed described;
  fields(described.head);
  while (!fields.empty()) {
    auto [head, values] = view_features(fields);
    described.head.features.push_back(std::move(head));
    described.values.push_back(values);
  }
  return described;
}

Described unpack_described(std::string_view bytes) {
  auto [described, values] = view_described(bytes);
  for (std::size_t i = 0; i < values.size(); ++i) {
    std::vector<float>& numbers = described.features[i].values;
    numbers.resize(values[i].length());
    std::ranges::copy(values[i].bytes, reinterpret_cast<char*>(numbers.data()));
  }
  return described;
}

bool spreads_points(const Settings& settings, WorkSplit split) {
  const bool dense = settings.prepare.spin_points >= kDenseSpinPoints && make_encoding(settings.encoding)->pools();
  return dense || split == WorkSplit::return_images;
}

EncodePrepared encode_on(TaskFarm& farm, const Settings& settings, WorkSplit split, const TaskFarm::Tick& tick) {
  return [&farm, &settings, split, tick](const Preparation& prepared) {
    const DenseObject dense{prepared.object.surface, prepared.object.spin_points, prepared.params};
    return encode_object(farm, dense, settings.encoding, split, tick);
  };
}

RankWork make_describe_work(std::string_view context, std::optional<TableRows>& rows,
                            const std::function<void()>& make_room) {
  auto [views, rows_to_keep, basis, limits, settings] = unpack<DescribeContext>(context);
  const FeatureBasis shared = basis.rows() > 0 ? std::make_shared<const FeatureMatrix>(std::move(basis)) : nullptr;
  RankWork result = throwing_problems(describe_work(settings, views, shared, limits));
  if (rows_to_keep > 0) {
    make_room();
    rows.emplace(rows_to_keep, static_cast<std::size_t>(views));
    result.keep = [&rows](std::size_t task, std::string_view described) {
      const std::vector<FeatureBytes> values = view_described(described).values;
      if (!values.empty()) {
        rows->put(task, values);
      }
    };
  }
  return result;
}

void describe_files(TaskFarm& farm, const DescribeJob& job, const DeliverDescribed& deliver,
                    const TaskFarm::Tick& tick) {
  if (spreads_points(job.settings, job.split)) {
    describe_by_points(farm, job, deliver, tick);
    return;
  }
  Job tasks;
  tasks.kind = kDescribeTasks;
  tasks.context = [&](Packer& packer) {
    packer(DescribeContext{job.views, job.keeps_rows ? job.files : 0, job.basis ? *job.basis : FeatureMatrix(),
                           job.limits, job.settings});
  };
  if (job.keeps_rows) {
    tasks.broadcasts = [&](std::string_view result) -> std::optional<bool> {
      const std::vector<FeatureBytes> values = view_described(result).values;
      if (values.empty()) {
        return std::nullopt;
      }
      return job.keeps_rows(values[0].length());
    };
  }
  tasks.work = describe_work(job.settings, job.views, job.basis, job.limits);
  tasks.is_worth_keeping = has_no_problem;
  tasks.tasks = job.files;
  tasks.task = [&](std::size_t i) { return job.file(i).string(); };
  tasks.deliver = [&](std::size_t i, const std::string& result) {
    const PackedDescribed described = view_described(result);
    check_finite(described, job.file(i));
    deliver(i, described.head, described.values);
  };
  farm.run(tasks, tick);
}

}  // namespace spincat
