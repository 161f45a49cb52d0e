// Private to the library, not installed: from a data set to its feature table.
#pragma once

#include <cstddef>

#include "spincat/dataset/dataset.h"
#include "spincat/execution.h"
#include "spincat/settings/settings.h"
#include "spincat/train/broadcast_rows.h"
#include "spincat/train/feature_table.h"

namespace spincat {

// Reads and describes every object of the data set once, with its copies. The result does not depend on the execution.
// Objects that cannot be read are left out and listed with their reason, or are an error where the execution is strict.
// Throws InputError when fewer than two categories are left.
FeatureTable describe_dataset(const Dataset& dataset, const Settings& settings, const Execution& execution);

// Tables of so many rows hold all features; where judges learn in a small space, larger ones hold coordinates along the
// directions in which a sample of the objects varies most, so that memory and work grow with the objects and no faster.
inline constexpr std::size_t kNeverAlongBasis = static_cast<std::size_t>(-1);

// The same, as coordinates where there are more than `most_whole_rows` rows. Where the plan of so many trainings makes
// it worth it (worth_broadcasting.h), other ranks get the features as they come; `broadcast` tells.
FeatureTable describe_dataset(const Dataset& dataset, const Settings& settings, const Execution& execution,
                              std::size_t trainings, std::size_t most_whole_rows, BroadcastRows& broadcast);

}  // namespace spincat
