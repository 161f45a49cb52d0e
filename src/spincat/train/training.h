// What the judges of one training have in common.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "spincat/encode/codebook.h"
#include "spincat/judge/judge_list.h"
#include "spincat/judge/known_judge.h"
#include "spincat/train/feature_table.h"
#include "spincat/train/learned_space.h"

namespace spincat {

// Whether inner products of so many rows, in so many matrices, are worth keeping: below a gigabyte (16,384 rows with
// one matrix).
bool fits_gram(Eigen::Index rows, Eigen::Index matrices);

// A training on some objects of a table and their copies. Where the table holds local features, their codebook is
// learned first, and where the settings ask for one, the small space that judges learn in: from these objects alone.
// Judges may be trained by several threads at once. Deterministic.
class Training {
 public:
  // `gram` is that of the whole table or empty. What is passed by reference must outlive this object.
  // Precondition: every category has an object among them.
  Training(const FeatureTable& table, const GramMatrices& gram, std::span<const std::uint32_t> objects,
           const JudgeSettings& settings);
  Training(const Training&) = delete;
  Training& operator=(const Training&) = delete;

  // The judges of the given pairs.
  std::vector<Judge> train(std::span<const CategoryPair> pairs) const;

  // Whether judges can do without their support vectors: those of a linear kernel.
  bool folds() const { return settings_.kernel == KernelKind::linear; }
  // How many numbers the judges see of an object.
  std::size_t seen_length() const;
  // Precondition of both: it folds.
  FoldedJudge fold(const Judge& judge) const { return training_->fold(judge); }
  JudgeList unfilled_list(std::size_t judges) const;

  // All judges, put together.
  JudgeList list(std::span<const Judge> judges) const;

  // The judge of known and unknown, which learns from the background but for the given rows, in order. Preconditions:
  // there is a small space; other rows of background are left.
  KnownJudge train_known_judge(std::span<const std::uint32_t> but) const;
  std::vector<double> known_margins(const KnownJudge& judge, std::span<const std::uint32_t> rows) const;

  const FeatureTable& table() const { return table_; }

  // What some judges say of other objects of the table: a row for each object, or for each of its views.
  FeatureMatrix margins(std::span<const Judge> judges, std::span<const std::uint32_t> objects) const;

 private:
  const FeatureMatrix& learn_words(std::span<const std::uint32_t> rows);
  std::vector<std::uint32_t> tested_rows_of(std::span<const std::uint32_t> objects) const;

  const FeatureTable& table_;
  const bool has_gram_;
  const JudgeSettings settings_;
  Codebook codebook_;
  FeatureMatrix counted_;  // what the codebook counts in the rows of the table
  GramMatrices counted_gram_;
  std::optional<LearnedSpace> space_;
  std::vector<std::uint32_t> rows_;  // that it learns from
  GramMatrices no_gram_;             // of the space's places: short enough that each pair makes its own
  std::optional<TrainingSet> training_;
};

}  // namespace spincat
