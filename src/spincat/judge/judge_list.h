// The chain judges list (paper, section on classification): one judge for every pair of categories.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "spincat/encode/codebook.h"
#include "spincat/judge/ballot.h"
#include "spincat/judge/gram.h"
#include "spincat/judge/kernel.h"
#include "spincat/judge/settings.h"
#include "spincat/judge/whitening.h"

namespace spincat {

// A pair of categories, a < b.
struct CategoryPair {
  std::uint32_t a = 0;
  std::uint32_t b = 0;
};

// All L = n (n - 1) / 2 pairs in the order of the judges: (0,1), (0,2), ..., (1,2), ...
std::vector<CategoryPair> all_pairs(std::uint32_t categories);

// An SVM that tells two categories apart: margin(x) = sum over s of coefficients[s] K(row rows[s], x) + bias; above 0
// it speaks for the first.
struct Judge {
  std::vector<std::uint32_t> rows;  // support vectors: the training objects it leans on
  std::vector<double> coefficients;
  float bias = 0.0F;
};

// A linear judge without its support vectors: margin(x) = weights . x + bias.
struct FoldedJudge {
  Eigen::RowVectorXf weights;  // D: the sum of coefficient times support vector
  float bias = 0.0F;
  std::uint32_t support_vectors = 0;  // how many there were
};

struct JudgeList;

// What judges are trained on.
class TrainingSet {
 public:
  // Those rows of `features` that `rows` lists; `labels` has the category of each row of features. `kernel` is fitted
  // to these rows, and `shared_gram` is that of all features for its kind, or empty: then linear judges learn from the
  // rows themselves (linear_svm.h), and with another kernel every pair computes its own part. What is passed by
  // reference must outlive this object.
  TrainingSet(const FeatureMatrix& features, const GramMatrices& shared_gram, Kernel kernel,
              std::span<const std::uint32_t> labels, std::span<const std::uint32_t> rows, std::uint32_t categories);

  std::uint32_t categories() const { return static_cast<std::uint32_t>(rows_of_.size()); }

  // Trains the judge of one pair. Pairs are independent: they may be trained at the same time and in any order.
  // Deterministic. Precondition: both categories have a row.
  Judge train(CategoryPair pair, const JudgeSettings& settings) const;

  // Deterministic. Precondition: the kernel is linear.
  FoldedJudge fold(const Judge& judge) const;

  // A list of so many judges, all still to be put into it. Precondition: the kernel is linear.
  JudgeList unfilled_list(std::size_t judges) const;

  // All judges in the order of all_pairs, put together. Linear ones are folded. With another kernel, support vectors
  // that several judges share are kept once.
  JudgeList list(std::span<const Judge> judges) const;

  // What judges say of some rows, from the inner products that they share: a row for each, a column for each judge. As
  // the list's margins up to rounding, and sooner. Deterministic. Precondition: there are shared inner products, or the
  // kernel is linear.
  FeatureMatrix margins(std::span<const Judge> judges, std::span<const std::uint32_t> rows) const;

 private:
  bool is_trained_on_rows() const { return kernel_.kind == KernelKind::linear && shared_gram_.empty(); }
  JudgeList list_with_supports(std::span<const Judge> judges) const;
  FeatureMatrix margins_of_folded(std::span<const Judge> judges, std::span<const std::uint32_t> rows) const;

  const FeatureMatrix& features_;
  const GramMatrices& shared_gram_;
  Kernel kernel_;
  std::vector<std::vector<std::uint32_t>> rows_of_;  // of each category
  std::size_t objects_ = 0;
};

// All judges, folded into one matrix: voting is one matrix-vector product, after one row of the kernel where that is
// not linear.
//
//   linear:  margin of judge l on object x:   weights.row(l) . x + bias(l)   (x: its place, where there is a whitening)
//   rbf:     margin of judge l on object x:   weights.row(l) . kernel.row(supports, x) + bias(l)
struct JudgeList {
  std::uint32_t categories = 0;
  FeatureMatrix weights;                       // L x D (linear) or L x S: the support vectors' coefficients
  Eigen::VectorXf bias;                        // L
  std::vector<std::uint32_t> support_vectors;  // L: how many each judge leans on
  Kernel kernel;
  Whitening whitening;     // where judges learn in a small space: x is then the object's place in it
  Codebook codebook;       // where the encoding gives local features: x is then what it counts among them
  FeatureMatrix supports;  // S x D: the support vectors of all judges, each once; none for the linear kernel

  std::size_t size() const { return support_vectors.size(); }

  // Makes judge l of a list of linear ones. Precondition: it has as many weights as the others.
  void put(std::size_t l, const FoldedJudge& judge);

  // D: how many features the kernel sees of an object.
  std::size_t seen_length() const {
    return static_cast<std::size_t>(kernel.kind == KernelKind::linear ? weights.cols() : supports.cols());
  }

  // How many features an object needs: D, or what the whitening or the codebook takes.
  std::size_t feature_length() const {
    return !codebook.empty() ? codebook.input_length() : !whitening.empty() ? whitening.input_length() : seen_length();
  }

  // What the kernel sees of an object with these features: D numbers.
  std::vector<float> seen(std::span<const float> features) const;

  // Every judge's margin for feature vectors of feature_length() numbers each: a row for each of them. Deterministic,
  // and the same for one vector and for many; many at a time are faster.
  FeatureMatrix margins(std::span<const std::span<const float>> objects) const;
  // The same for what seen() gives of them.
  FeatureMatrix margins_on(std::span<const std::vector<float>> seen_features) const;

  // Every judge's word on one feature vector, or on what seen() gives of it. Deterministic.
  Ballot vote(std::span<const float> features) const { return vote_on(seen(features)); }
  Ballot vote_on(std::span<const float> seen_features) const;
};

}  // namespace spincat
