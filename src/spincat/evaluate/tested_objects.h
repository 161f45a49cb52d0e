// Objects that are only tested, described in the form in which they are tested.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "spincat/dataset/dataset.h"
#include "spincat/describe/describe.h"
#include "spincat/describe/kinds.h"
#include "spincat/evaluate/evaluate.h"
#include "spincat/execution.h"
#include "spincat/judge/gram.h"
#include "spincat/parallel/task.h"
#include "spincat/settings/settings.h"

namespace spincat {

// The name of this kind of work, as ranks tell each other.
inline constexpr const char* kTestedTasks = "feature vectors of test objects";

struct TestTable {
  std::vector<DatasetObject> objects;  // N, as they were handed in
  std::uint32_t rows_per_object = 1;   // one, or all views of it
  FeatureMatrix features;              // N rows_per_object x D; the rows of objects with a problem are zero
  std::vector<std::string> problems;   // N: why an object could not be described; empty where it could
  KindCounts kinds;                    // of those that could be read, in the form in which they are tested
  StageSeconds seconds;                // added up over threads

  std::span<const float> features_of(std::uint32_t object, std::uint32_t view = 0) const;
};

// Reads and describes objects, without copies, or as many views of them as settings.tested_rows() says; those that
// cannot be read or do not give `length` numbers (as coordinates along the basis, where it has rows) get their reason
// instead, or are an error where the execution is strict. Each object is altered by a seed of its own, made from
// settings.seed and its place. The result does not depend on the execution but for its limits.
TestTable describe_tested(std::span<const DatasetObject> objects, const FeatureMatrix& basis, Eigen::Index length,
                          const Settings& settings, const TestOptions& options, const Execution& execution);

// Its work, for other ranks.
Work make_tested_work(std::string_view context);

}  // namespace spincat
