// How like the objects that judges were trained on an object is: what tells a stranger from a hard case.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "spincat/judge/gram.h"

namespace spincat {

// The training objects themselves, and how near to each other those of a category lie. Empty where nothing is known.
struct Familiarity {
  FeatureMatrix objects;  // N x E, without copies: the first E of the judges' D features; a row for each view of an
                          // object where judges are trained by views
  std::vector<std::uint32_t> labels;  // N
  std::vector<float> typical;  // of each category: the mean squared distance of its objects to their nearest neighbour
                               // in it; of all categories together where it has a single object
  std::vector<float> spread;   // of each category: the standard deviation of these, and a fifth of the mean over all
                               // categories, so that a few objects that lie close give no certainty

  bool empty() const { return labels.empty(); }

  // (typical - d) / spread, where d is the squared distance of the object to the nearest training object of the
  // category: around 0 for one of its kind, far below 0 for a stranger. 0 when empty. Preconditions: `features`
  // are E or more, the category has an object.
  double of(std::span<const float> features, std::uint32_t category) const;
};

// Every `rows_each` rows are one object, and not each other's neighbours. Deterministic. Preconditions: a label for
// each row of `objects`, each below `categories`; a whole number of objects.
Familiarity make_familiarity(FeatureMatrix objects, std::vector<std::uint32_t> labels, std::uint32_t categories,
                             std::uint32_t rows_each = 1);

}  // namespace spincat
