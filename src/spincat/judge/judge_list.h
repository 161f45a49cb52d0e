// The chain judges list (paper, section on classification): one judge for every pair of categories.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "spincat/judge/ballot.h"
#include "spincat/judge/gram.h"
#include "spincat/judge/settings.h"

namespace spincat {

// A pair of categories, a < b.
struct CategoryPair {
  std::uint32_t a = 0;
  std::uint32_t b = 0;
};

// All L = n (n - 1) / 2 pairs in the order of the judges: (0,1), (0,2), ..., (1,2), ...
std::vector<CategoryPair> all_pairs(std::uint32_t categories);

// A linear SVM that tells two categories apart: weights . x + bias > 0 speaks for the first.
struct Judge {
  Eigen::RowVectorXf weights;  // D
  float bias = 0.0F;
  std::uint32_t support_vectors = 0;  // how many training objects it leans on
};

// What judges are taught on.
class TrainingSet {
 public:
  // Those rows of `features` that `rows` lists; `labels` has the category of each row of features. `shared_gram` is
  // gram_matrix(features), or empty: then every pair computes its own part, which takes longer but no memory beyond a
  // pair's (and may differ from the shared one in the last bit). What is passed by reference must outlive this object.
  TrainingSet(const FeatureMatrix& features, const Eigen::MatrixXf& shared_gram, std::span<const std::uint32_t> labels,
              std::span<const std::uint32_t> rows, std::uint32_t categories);

  std::uint32_t categories() const { return static_cast<std::uint32_t>(rows_of_.size()); }

  // Teaches the judge of one pair. Pairs are independent: they may be taught at the same time and in any order.
  // Deterministic. Precondition: both categories have a row.
  Judge teach(CategoryPair pair, const JudgeSettings& settings) const;

 private:
  Eigen::MatrixXf gram_of(std::span<const std::uint32_t> rows) const;

  const FeatureMatrix& features_;
  const Eigen::MatrixXf& shared_gram_;
  std::vector<std::vector<std::uint32_t>> rows_of_;  // of each category
  std::size_t objects_ = 0;
};

// All judges, folded into one matrix: voting is one matrix-vector product.
//
//   margin of judge l on object x:   weights.row(l) . x + bias(l)
struct JudgeList {
  std::uint32_t categories = 0;
  FeatureMatrix weights;                       // L x D
  Eigen::VectorXf bias;                        // L
  std::vector<std::uint32_t> support_vectors;  // L

  // From the judges in the order of all_pairs.
  static JudgeList fold(std::uint32_t categories, std::span<const Judge> judges);

  std::size_t size() const { return support_vectors.size(); }

  // Every judge's word on one feature vector (D numbers). Deterministic. Precondition: D matches.
  Ballot vote(std::span<const float> features) const;
};

}  // namespace spincat
