// Known or unknown: what tells objects of the learned categories from those of none.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "spincat/judge/gram.h"
#include "spincat/judge/platt_scaling.h"

namespace spincat {

// A linear SVM of all training rows against a background of objects of no category, all as the pairwise judges see
// them. Without weights nothing is known of strangers: every object counts as known.
struct KnownJudge {
  Eigen::RowVectorXf weights;  // D
  float bias = 0.0F;
  PlattScaling scaling;  // from its margin to how likely an object of a category is rather than one of the
                         // background, were both as frequent
  double least = 0.0;    // what nearly all known objects have, in [0, 1]: with less, an object counts as unknown

  bool empty() const { return weights.size() == 0; }
  // Above 0 for what looks known. Precondition: D numbers.
  float margin(std::span<const float> seen) const;
  // In (0, 1]; 1 where nothing is known of strangers.
  double known(std::span<const float> seen) const {
    return empty() ? 1.0 : scaling.probability(static_cast<double>(margin(seen)));
  }
};

// What is known of a row of features.
struct RowOrigin {
  std::uint32_t category = 0;
  std::uint32_t object = 0;
};

// Those background rows that are unlike all known ones: less like the nearest of these than nine in ten known rows are
// like the nearest row of another object of their category (by cosine). What looks like a category says nothing of
// strangers. All of them where no category has two objects. `origins` are those of `known`. Of many known rows evenly
// spread ones are looked at. Deterministic. Precondition: rows of length 1.
std::vector<std::uint32_t> unlike_known(const FeatureMatrix& seen, std::span<const std::uint32_t> known,
                                        std::span<const RowOrigin> origins, std::span<const std::uint32_t> background);

// C = 50, each side's price by its share of the rows. Deterministic. Precondition: a row on either side.
KnownJudge train_known_judge(const FeatureMatrix& seen, std::span<const std::uint32_t> known,
                             std::span<const std::uint32_t> background);

// Fits the scaling, and the least value so that 3 % of the known objects have less. Unchanged for fewer than ten of
// either. Margins are of judges that were trained on other objects.
void calibrate_known(std::span<const double> known, std::span<const double> strangers, KnownJudge& judge);

}  // namespace spincat
