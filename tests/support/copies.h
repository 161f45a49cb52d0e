// Training copies, described and prepared.
#pragma once

#include "spincat/describe/describe.h"
#include "spincat/describe/training_copies.h"

namespace spincat::test {

inline FeatureVector describe_copy(const Object& object, const Settings& settings, int k) {
  const auto [copy, seed] = training_copy(object, settings, k);
  return describe(copy, settings, seed);
}

inline Preparation prepare_copy(const Object& object, const Settings& settings, int k) {
  const auto [copy, seed] = training_copy(object, settings, k);
  return prepare_object(copy, settings, seed);
}

}  // namespace spincat::test
