// The background: objects of no category, which tell those of the categories from strangers.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "spincat/dataset/dataset.h"
#include "spincat/describe/describe_tasks.h"
#include "spincat/judge/gram.h"
#include "spincat/parallel/farm_execution.h"
#include "spincat/parallel/task.h"
#include "spincat/settings/settings.h"

namespace spincat {

// The name of this kind of work, as ranks tell each other.
inline constexpr const char* kBackgroundTasks = "feature vectors of the background";

// The features of the data set's others, as the user has them, and of the shapes that we make ourselves
// (background/background_shapes.h), a row for each, or their coordinates along the basis. Others that cannot be read
// are skipped, or are an error where the execution is strict. The result does not depend on the execution.
struct Background {
  FeatureMatrix rows;
  std::uint32_t others = 0;            // the first ones
  std::vector<SkippedObject> skipped;  // others
};
Background describe_background(const Dataset& dataset, const Settings& settings, const FarmExecution& run,
                               const FeatureBasis& basis);

// Its work, for other ranks.
Work make_background_work(std::string_view context);

}  // namespace spincat
