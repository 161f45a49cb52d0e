// The chain judges list (paper, section on classification): one judge for every pair of categories.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "spincat/judge/ballot.h"
#include "spincat/judge/gram.h"
#include "spincat/judge/settings.h"

namespace spincat {

// All L = n (n - 1) / 2 linear judges, folded into one matrix: voting is one matrix-vector product.
//
//   margin of judge l on object x:   weights.row(l) . x + bias(l),   l in the order (0,1), (0,2), ..., (1,2), ...
struct JudgeList {
  std::uint32_t categories = 0;
  FeatureMatrix weights;  // L x D
  Eigen::VectorXf bias;   // L
  std::vector<std::uint32_t> support_vectors;  // of each judge: how many training objects it leans on

  std::size_t size() const { return static_cast<std::size_t>(bias.size()); }

  // Every judge's word on one feature vector (D numbers). Deterministic. Precondition: D matches.
  Ballot vote(std::span<const float> features) const;
};

// Teaches every pair of the `categories` on those rows of `features` that `rows` lists; `gram` is gram_matrix(features)
// and `labels` the category of each row of features. Judges are independent and are taught on `threads` threads; the
// result does not depend on how many. Precondition: every category has a row in `rows`.
JudgeList train_judges(const FeatureMatrix& features, const Eigen::MatrixXf& gram,
                       std::span<const std::uint32_t> labels, std::span<const std::uint32_t> rows,
                       std::uint32_t categories, const JudgeSettings& settings, int threads);

}  // namespace spincat
