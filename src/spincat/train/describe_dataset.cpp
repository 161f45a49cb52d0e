#include "spincat/train/describe_dataset.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <iterator>
#include <memory>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "spincat/describe/describe_tasks.h"
#include "spincat/describe/table_rows.h"
#include "spincat/error.h"
#include "spincat/geometry/evenly_spread.h"
#include "spincat/parallel/farm_execution.h"
#include "spincat/train/background.h"
#include "spincat/train/learned_space.h"
#include "spincat/train/worth_broadcasting.h"

namespace spincat {
namespace {

// What is remembered of each object but for its features, which go into the table's rows at once.
struct Seen {
  Described described;  // its feature vectors without their values
  std::size_t shortest = 0;
};

// Concatenated images are as many as the spin points: an object with fewer points than the others (a small cloud whose
// points are not repeated) cannot be compared with them.
void leave_out_shorter(const Dataset& dataset, bool strict, std::size_t length, std::span<Seen> objects) {
  for (std::size_t i = 0; i < objects.size(); ++i) {
    auto& [described, shortest] = objects[i];
    if (described.features.empty() || shortest == length) {
      continue;
    }
    described.problem = fmt::format("gives {} features where others give {}", shortest, length);
    described.features.clear();
    if (strict) {
      throw InputError(dataset.objects[i].file.string(), described.problem);
    }
  }
}

// Throws when the objects that are left can teach nothing.
void check_categories(const FeatureTable& table, const std::string& dataset) {
  if (table.categories.size() < 2) {
    throw InputError(dataset, "two or more categories are needed to learn from");
  }
  std::vector<bool> present(table.categories.size(), false);
  for (const DatasetObject& object : table.objects) {
    present[object.category] = true;
  }
  const auto missing = std::ranges::find(present, false);
  if (missing == present.end()) {
    return;
  }
  std::string problem = fmt::format("no object of category '{}' could be read",
                                    table.categories[static_cast<std::size_t>(missing - present.begin())]);
  if (!table.skipped.empty()) {
    problem += fmt::format(" ({} could not; the first, {}: {})", table.skipped.size(),
                           table.skipped.front().file.string(), table.skipped.front().reason);
  }
  throw InputError(dataset, problem);
}

// All described objects, in the order of the data set, but for their features; `described` gets their places in it.
FeatureTable collect(const Dataset& dataset, std::span<const Seen> objects, const Settings& settings,
                     std::vector<std::uint32_t>& described) {
  FeatureTable table;
  table.categories = dataset.categories;
  table.skipped = dataset.skipped;
  table.words = static_cast<std::uint32_t>(settings.words);
  table.seed = settings.seed;
  table.rows_per_object = static_cast<std::uint32_t>(settings.training_rows());
  table.tested_rows = static_cast<std::uint32_t>(settings.tested_rows());
  for (std::uint32_t i = 0; i < objects.size(); ++i) {
    const Described& one = objects[i].described;
    table.seconds += one.seconds;
    if (one.features.empty()) {
      table.skipped.push_back({dataset.objects[i].file, one.problem});
    } else {
      table.objects.push_back(dataset.objects[i]);
      described.push_back(i);
      table.kinds.add(one.kind);
      table.encoding = one.features[0].encoding;
      table.local_size = one.features[0].local_size;
      table.blocks = one.features[0].blocks;
    }
  }
  std::ranges::stable_sort(table.skipped, {}, &SkippedObject::file);
  return table;
}

// Describes the objects of a data set, some at a time.
class Describing {
 public:
  using Put = std::function<void(std::uint32_t object, std::span<const FeatureBytes> rows)>;
  using KeepsRows = std::function<bool(std::size_t length)>;

  // What is passed by reference must outlive this object.
  Describing(const Dataset& dataset, const Settings& settings, const FarmExecution& run)
      : dataset_(dataset), settings_(settings), run_(run), objects_(dataset.objects.size()) {}

  // `put` gets the rows of each that can be described: features, or coordinates along a basis.
  void describe(std::span<const std::uint32_t> which, const FeatureBasis& basis, const Put& put,
                const KeepsRows& keeps_rows = {}) {
    const auto file = [&](std::size_t i) -> const std::filesystem::path& { return dataset_.objects[which[i]].file; };
    const DescribeJob job{which.size(),    file,       settings_, settings_.training_rows(), run_.split,
                          dataset_.limits, keeps_rows, basis};
    const auto keep = [&](std::size_t i, const Described& one, std::span<const FeatureBytes> rows) {
      keep_facts(which[i], one, rows);
      if (!rows.empty()) {
        put(which[i], rows);
      }
    };
    const TaskFarm::Tick tick = run_.ticking("describing objects", objects_.size());
    describe_files(*run_.farm, job, keep, [&](std::size_t done) { tick(described_ + done); });
    described_ += which.size();
  }

  std::span<Seen> objects() { return objects_; }

 private:
  void keep_facts(std::uint32_t object, const Described& one, std::span<const FeatureBytes> rows) {
    const std::filesystem::path& file = dataset_.objects[object].file;
    if (one.lacks_memory) {  // a model of fewer objects, and nobody would know why it is worse
      throw RunError(file.string(), one.problem);
    }
    if (run_.strict && rows.empty()) {
      throw InputError(file.string(), one.problem);
    }
    if (!rows.empty()) {
      objects_[object].shortest = std::ranges::min(rows, {}, &FeatureBytes::length).length();
    }
    objects_[object].described = one;
  }

  const Dataset& dataset_;
  const Settings& settings_;
  const FarmExecution& run_;
  std::vector<Seen> objects_;
  std::size_t described_ = 0;
};

std::vector<std::uint32_t> all_of(std::size_t count) {
  std::vector<std::uint32_t> all(count);
  std::iota(all.begin(), all.end(), 0U);
  return all;
}

// Objects evenly spread over the data set, as many as give the rows of a sample; and all others.
struct SampleAndRest {
  std::vector<std::uint32_t> sample;
  std::vector<std::uint32_t> rest;

  SampleAndRest(std::size_t objects, std::size_t rows_each) {
    const std::vector<std::uint32_t> all = all_of(objects);
    const std::size_t most = std::max<std::size_t>(kMostSampleRows / rows_each, 1);
    sample = evenly_spread(std::span<const std::uint32_t>(all), most);
    std::ranges::set_difference(all, sample, std::back_inserter(rest));
  }
};

// Every object's features.
TableRows describe_whole(Describing& describing, std::size_t rows_each, const Describing::KeepsRows& keeps_rows) {
  const std::vector<std::uint32_t> all = all_of(describing.objects().size());
  TableRows rows(all.size(), rows_each);
  describing.describe(
      all, {}, [&](std::uint32_t i, std::span<const FeatureBytes> of) { rows.put(i, of); }, keeps_rows);
  return rows;
}

// Every object's coordinates along the directions in which those of a sample vary most, which `basis` gets.
TableRows describe_along_basis(Describing& describing, std::size_t rows_each, const Settings& settings, int threads,
                               FeatureBasis& basis) {
  const std::size_t objects = describing.objects().size();
  const auto [sample, rest] = SampleAndRest(objects, rows_each);
  TableRows whole(sample.size(), rows_each);
  std::vector<std::uint32_t> found;  // places in the sample
  describing.describe(sample, {}, [&](std::uint32_t i, std::span<const FeatureBytes> of) {
    found.push_back(static_cast<std::uint32_t>(std::ranges::lower_bound(sample, i) - sample.begin()));
    whole.put(found.back(), of);
  });
  TableRows rows(objects, rows_each);
  if (!found.empty()) {
    const auto [directions, coordinates] = coordinates_of(whole.take(found), settings.judge.dimensions, threads);
    basis = std::make_shared<const FeatureMatrix>(directions);
    for (std::size_t k = 0; k < found.size(); ++k) {
      std::vector<FeatureBytes> of;
      for (std::size_t row = k * rows_each; row < (k + 1) * rows_each; ++row) {
        of.emplace_back(std::span<const float>(coordinates.row(static_cast<Eigen::Index>(row)).data(),
                                               static_cast<std::size_t>(coordinates.cols())));
      }
      rows.put(sample[found[k]], of);
      describing.objects()[sample[found[k]]].shortest = rows.length();
    }
  }
  describing.describe(rest, basis, [&](std::uint32_t i, std::span<const FeatureBytes> of) { rows.put(i, of); });
  return rows;
}

void append_rows(const FeatureMatrix& more, FeatureMatrix& rows) {
  if (more.rows() == 0) {
    return;
  }
  const Eigen::Index before = rows.rows();
  rows.conservativeResize(before + more.rows(), Eigen::NoChange);
  rows.bottomRows(more.rows()) = more;
}

}  // namespace

FeatureTable describe_dataset(const Dataset& dataset, const Settings& settings, const Execution& execution) {
  BroadcastRows broadcast;
  return describe_dataset(dataset, settings, execution, 0, kNeverAlongBasis, broadcast);
}

FeatureTable describe_dataset(const Dataset& dataset, const Settings& settings, const Execution& execution,
                              std::size_t trainings, std::size_t most_whole_rows, BroadcastRows& broadcast) {
  settings.validate();
  settings.validate_for_judges();
  const FarmExecution run(execution);
  if (run.strict && !dataset.skipped.empty()) {
    throw InputError(dataset.skipped.front().file.string(), dataset.skipped.front().reason);
  }
  const auto rows_each = static_cast<std::size_t>(settings.training_rows());
  const std::size_t all_rows = dataset.objects.size() * rows_each;
  const bool has_space = settings.judge.dimensions > 0;
  Describing describing(dataset, settings, run);
  bool all_ranks_keep = false;
  const auto keeps_rows = [&](std::size_t length) {
    all_ranks_keep =
        !has_space &&
        worth_broadcasting({dataset.objects.size(), all_rows, length, dataset.categories.size()}, trainings, *run.farm);
    return all_ranks_keep;
  };
  FeatureBasis basis;
  TableRows rows = has_space && all_rows > most_whole_rows
                       ? describe_along_basis(describing, rows_each, settings, run.farm->threads(), basis)
                       : describe_whole(describing, rows_each, keeps_rows);
  leave_out_shorter(dataset, run.strict, rows.length(), describing.objects());
  std::vector<std::uint32_t> described;
  FeatureTable table = collect(dataset, describing.objects(), settings, described);
  table.features = rows.take(described);
  broadcast = all_ranks_keep ? BroadcastRows{next_broadcast_id(), std::move(described)} : BroadcastRows{};
  check_categories(table, dataset.name);
  if (basis) {
    table.basis = *basis;
  }
  if (has_space) {
    const Background background = describe_background(dataset, settings, run, basis);
    table.background_rows = static_cast<std::uint32_t>(background.rows.rows());
    table.other_rows = background.others;
    table.skipped.insert(table.skipped.end(), background.skipped.begin(), background.skipped.end());
    std::ranges::stable_sort(table.skipped, {}, &SkippedObject::file);
    append_rows(background.rows, table.features);
  }
  return table;
}

}  // namespace spincat
