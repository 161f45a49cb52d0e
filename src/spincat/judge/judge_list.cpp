#include "spincat/judge/judge_list.h"

#include <fmt/format.h>

#include <cmath>

#include "spincat/error.h"
#include "spincat/judge/pairwise_svm.h"

namespace spincat {

void JudgeSettings::validate() const {
  if (!(c > 0.0) || !std::isfinite(c)) {
    throw InputError(fmt::format("C {} is out of range (above 0)", c));
  }
}

std::vector<CategoryPair> all_pairs(std::uint32_t categories) {
  std::vector<CategoryPair> pairs;
  for (std::uint32_t a = 0; a < categories; ++a) {
    for (std::uint32_t b = a + 1; b < categories; ++b) {
      pairs.push_back({a, b});
    }
  }
  return pairs;
}

TrainingSet::TrainingSet(const FeatureMatrix& features, const Eigen::MatrixXf& shared_gram,
                         std::span<const std::uint32_t> labels, std::span<const std::uint32_t> rows,
                         std::uint32_t categories)
    : features_(features), shared_gram_(shared_gram), rows_of_(categories), objects_(rows.size()) {
  for (const std::uint32_t row : rows) {
    rows_of_[labels[row]].push_back(row);
  }
}

Eigen::MatrixXf TrainingSet::gram_of(std::span<const std::uint32_t> rows) const {
  if (shared_gram_.size() > 0) {
    return shared_gram_(rows, rows);
  }
  return gram_matrix(features_(rows, Eigen::all), 1);
}

Judge TrainingSet::teach(CategoryPair pair, const JudgeSettings& settings) const {
  const auto price = [&](std::uint32_t category) {
    const auto all = static_cast<double>(objects_);
    const auto ours = static_cast<double>(rows_of_[category].size());
    return settings.class_weights ? settings.c * all / (categories() * ours) : settings.c;
  };
  std::vector<std::uint32_t> rows = rows_of_[pair.a];
  rows.insert(rows.end(), rows_of_[pair.b].begin(), rows_of_[pair.b].end());
  const auto first_count = static_cast<std::uint32_t>(rows_of_[pair.a].size());
  const PairwiseSvm svm = train_pairwise_svm(gram_of(rows), first_count, price(pair.a), price(pair.b));

  // Folding: w = sum of coefficient times support vector, after which no support vector is needed any more.
  Eigen::RowVectorXd w = Eigen::RowVectorXd::Zero(features_.cols());
  for (std::size_t s = 0; s < svm.object.size(); ++s) {
    w += svm.coefficient[s] * features_.row(rows[svm.object[s]]).cast<double>();
  }
  return {w.cast<float>(), static_cast<float>(svm.bias), static_cast<std::uint32_t>(svm.object.size())};
}

JudgeList JudgeList::fold(std::uint32_t categories, std::span<const Judge> judges) {
  const auto count = static_cast<Eigen::Index>(judges.size());
  JudgeList list{
      categories, FeatureMatrix(count, judges.empty() ? 0 : judges[0].weights.size()), Eigen::VectorXf(count), {}};
  for (Eigen::Index l = 0; l < count; ++l) {
    const Judge& judge = judges[static_cast<std::size_t>(l)];
    list.weights.row(l) = judge.weights;
    list.bias[l] = judge.bias;
    list.support_vectors.push_back(judge.support_vectors);
  }
  return list;
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

}  // namespace spincat
