#include "spincat/judge/judge_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "spincat/error.h"
#include "spincat/judge/pairwise_svm.h"

namespace spincat {

double default_c(KernelKind kernel) {
  return kernel == KernelKind::linear ? 200.0 : 3.0;
}

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

TrainingSet::TrainingSet(const FeatureMatrix& features, const SharedGram& shared_gram, Kernel kernel,
                         std::span<const std::uint32_t> labels, std::span<const std::uint32_t> rows,
                         std::uint32_t categories)
    : features_(features),
      shared_gram_(shared_gram),
      kernel_(std::move(kernel)),
      rows_of_(categories),
      objects_(rows.size()) {
  for (const std::uint32_t row : rows) {
    rows_of_[labels[row]].push_back(row);
  }
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
  const PairwiseSvm svm = train_pairwise_svm(kernel_matrix(kernel_, features_, shared_gram_, rows), first_count,
                                             price(pair.a), price(pair.b));
  Judge judge;
  judge.bias = static_cast<float>(svm.bias);
  judge.support_vectors = static_cast<std::uint32_t>(svm.object.size());
  if (kernel_.kind != KernelKind::linear) {
    for (std::size_t s = 0; s < svm.object.size(); ++s) {
      judge.rows.push_back(rows[svm.object[s]]);
      judge.coefficients.push_back(static_cast<float>(svm.coefficient[s]));
    }
    return judge;
  }

  // Folding: w = sum of coefficient times support vector, after which no support vector is needed any more.
  Eigen::RowVectorXd w = Eigen::RowVectorXd::Zero(features_.cols());
  for (std::size_t s = 0; s < svm.object.size(); ++s) {
    w += svm.coefficient[s] * features_.row(rows[svm.object[s]]).cast<double>();
  }
  judge.weights = w.cast<float>();
  return judge;
}

JudgeList TrainingSet::list(std::span<const Judge> judges) const {
  // The place of each support vector among those that are kept, in the order of the table.
  std::map<std::uint32_t, Eigen::Index> place;
  for (const Judge& judge : judges) {
    for (const std::uint32_t row : judge.rows) {
      place.emplace(row, 0);
    }
  }
  const auto count = static_cast<Eigen::Index>(judges.size());
  JudgeList list;
  list.categories = categories();
  list.kernel = kernel_;
  list.supports.resize(static_cast<Eigen::Index>(place.size()), features_.cols());
  Eigen::Index next = 0;
  for (auto& [row, at] : place) {
    list.supports.row(next) = features_.row(row);
    at = next++;
  }
  list.weights.setZero(count, kernel_.kind == KernelKind::linear ? features_.cols() : next);
  list.bias.resize(count);
  for (Eigen::Index l = 0; l < count; ++l) {
    const Judge& judge = judges[static_cast<std::size_t>(l)];
    if (kernel_.kind == KernelKind::linear) {
      list.weights.row(l) = judge.weights;
    }
    for (std::size_t s = 0; s < judge.rows.size(); ++s) {
      list.weights(l, place.at(judge.rows[s])) = judge.coefficients[s];
    }
    list.bias[l] = judge.bias;
    list.support_vectors.push_back(judge.support_vectors);
  }
  return list;
}

std::size_t JudgeList::feature_length() const {
  return codebook.empty() ? seen_length() : codebook.input_length();
}

std::size_t JudgeList::seen_length() const {
  return static_cast<std::size_t>(kernel.kind == KernelKind::linear ? weights.cols() : supports.cols());
}

Ballot JudgeList::vote(std::span<const float> features) const {
  const std::vector<float> counted = codebook.empty() ? std::vector<float>() : codebook.count(features);
  const std::span<const float> seen = codebook.empty() ? features : std::span(counted);
  const bool linear = kernel.kind == KernelKind::linear;
  const Eigen::VectorXf alike = linear ? Eigen::VectorXf() : kernel.row(supports, seen);
  const std::span<const float> given = linear ? seen : std::span(alike.data(), static_cast<std::size_t>(alike.size()));
  const Eigen::Map<const Eigen::VectorXf> x(given.data(), static_cast<Eigen::Index>(given.size()));
  std::vector<float> margins(size());
  for (std::size_t l = 0; l < margins.size(); ++l) {
    const auto row = static_cast<Eigen::Index>(l);
    margins[l] = weights.row(row).dot(x) + bias[row];
  }
  return count_votes(categories, margins);
}

}  // namespace spincat
