#include "spincat/judge/judge_list.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "spincat/error.h"
#include "spincat/judge/pairwise_svm.h"

namespace spincat {
namespace {

std::vector<std::pair<std::uint32_t, std::uint32_t>> all_pairs(std::uint32_t categories) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (std::uint32_t a = 0; a < categories; ++a) {
    for (std::uint32_t b = a + 1; b < categories; ++b) {
      pairs.emplace_back(a, b);
    }
  }
  return pairs;
}

// w = sum of coefficient times support vector: f(x) = w . x + bias needs no support vectors any more.
Eigen::RowVectorXf folded(const PairwiseSvm& svm, const FeatureMatrix& features) {
  Eigen::RowVectorXd w = Eigen::RowVectorXd::Zero(features.cols());
  for (std::size_t s = 0; s < svm.row.size(); ++s) {
    w += svm.coefficient[s] * features.row(svm.row[s]).cast<double>();
  }
  return w.cast<float>();
}

}  // namespace

void JudgeSettings::validate() const {
  if (!(c > 0.0) || !std::isfinite(c)) {
    throw InputError(fmt::format("C {} is out of range (above 0)", c));
  }
}

Ballot JudgeList::vote(std::span<const float> features) const {
  const Eigen::Map<const Eigen::VectorXf> x(features.data(), static_cast<Eigen::Index>(features.size()));
  std::vector<float> margins(size());
  for (std::size_t l = 0; l < margins.size(); ++l) {
    const auto row = static_cast<Eigen::Index>(l);
    margins[l] = weights.row(row).dot(x) + bias[row];
  }
  return count_votes(categories, margins);
}

JudgeList train_judges(const FeatureMatrix& features, const Eigen::MatrixXf& gram,
                       std::span<const std::uint32_t> labels, std::span<const std::uint32_t> rows,
                       std::uint32_t categories, const JudgeSettings& settings, int threads) {
  std::vector<std::vector<std::uint32_t>> rows_of(categories);
  for (const std::uint32_t row : rows) {
    rows_of[labels[row]].push_back(row);
  }
  const auto price = [&](std::uint32_t category) {
    const double share = static_cast<double>(rows.size()) / (categories * static_cast<double>(rows_of[category].size()));
    return settings.class_weights ? settings.c * share : settings.c;
  };
  const auto pairs = all_pairs(categories);
  const auto count = static_cast<Eigen::Index>(pairs.size());
  JudgeList judges{categories, FeatureMatrix(count, features.cols()), Eigen::VectorXf(count), {}};
  judges.support_vectors.resize(pairs.size());
#pragma omp parallel for schedule(dynamic) num_threads(threads)
  for (std::size_t l = 0; l < pairs.size(); ++l) {
    const auto [a, b] = pairs[l];
    const PairwiseSvm svm = train_pairwise_svm(gram, rows_of[a], rows_of[b], price(a), price(b));
    const auto row = static_cast<Eigen::Index>(l);
    judges.weights.row(row) = folded(svm, features);
    judges.bias[row] = static_cast<float>(svm.bias);
    judges.support_vectors[l] = static_cast<std::uint32_t>(svm.row.size());
  }
  return judges;
}

}  // namespace spincat
