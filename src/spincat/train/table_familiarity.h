// Familiarity with the objects of a table.
#pragma once

#include <cstdint>
#include <span>

#include "spincat/judge/familiarity.h"
#include "spincat/train/feature_table.h"

namespace spincat {

// The given objects as familiarity sees them: the first part of their features (what is seen from outside), without
// copies (of views the first four): unknown objects stand out in it more than in all parts together
// (docs/how-it-works/confidence.md). Empty where the table has none to compare objects by.
Familiarity familiarity_of(const FeatureTable& table, std::span<const std::uint32_t> objects);

}  // namespace spincat
