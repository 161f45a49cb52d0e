#include "spincat/judge/judge_list.h"

#include <algorithm>
#include <map>
#include <utility>

#include "spincat/judge/linear_svm.h"
#include "spincat/judge/pairwise_svm.h"

namespace spincat {

std::vector<CategoryPair> all_pairs(std::uint32_t categories) {
  std::vector<CategoryPair> pairs;
  for (std::uint32_t a = 0; a < categories; ++a) {
    for (std::uint32_t b = a + 1; b < categories; ++b) {
      pairs.push_back({a, b});
    }
  }
  return pairs;
}

TrainingSet::TrainingSet(const FeatureMatrix& features, const GramMatrices& shared_gram, Kernel kernel,
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

Judge TrainingSet::train(CategoryPair pair, const JudgeSettings& settings) const {
  const auto price = [&](std::uint32_t category) {
    const auto all = static_cast<double>(objects_);
    const auto ours = static_cast<double>(rows_of_[category].size());
    return settings.class_weights ? settings.c * all / (categories() * ours) : settings.c;
  };
  std::vector<std::uint32_t> rows = rows_of_[pair.a];
  rows.insert(rows.end(), rows_of_[pair.b].begin(), rows_of_[pair.b].end());
  const auto first_count = static_cast<std::uint32_t>(rows_of_[pair.a].size());
  const PairwiseSvm svm = is_trained_on_rows()
                              ? train_linear_svm(features_(rows, Eigen::all), first_count, price(pair.a), price(pair.b))
                              : train_pairwise_svm(kernel_matrix(kernel_, features_, shared_gram_, rows), first_count,
                                                   price(pair.a), price(pair.b));
  Judge judge{{}, svm.coefficient, static_cast<float>(svm.bias)};
  for (const std::uint32_t object : svm.object) {
    judge.rows.push_back(rows[object]);
  }
  return judge;
}

FoldedJudge TrainingSet::fold(const Judge& judge) const {
  Eigen::RowVectorXd w = Eigen::RowVectorXd::Zero(features_.cols());
  for (std::size_t s = 0; s < judge.rows.size(); ++s) {
    w += judge.coefficients[s] * features_.row(judge.rows[s]).cast<double>();
  }
  return {w.cast<float>(), judge.bias, static_cast<std::uint32_t>(judge.rows.size())};
}

JudgeList TrainingSet::unfilled_list(std::size_t judges) const {
  JudgeList list;
  list.categories = categories();
  list.kernel = kernel_;
  list.weights.resize(static_cast<Eigen::Index>(judges), features_.cols());
  list.bias.resize(static_cast<Eigen::Index>(judges));
  list.support_vectors.resize(judges);
  return list;
}

JudgeList TrainingSet::list(std::span<const Judge> judges) const {
  if (kernel_.kind != KernelKind::linear) {
    return list_with_supports(judges);
  }
  JudgeList list = unfilled_list(judges.size());
  for (std::size_t l = 0; l < judges.size(); ++l) {
    list.put(l, fold(judges[l]));
  }
  return list;
}

JudgeList TrainingSet::list_with_supports(std::span<const Judge> judges) const {
  JudgeList list;
  list.categories = categories();
  list.kernel = kernel_;
  list.bias.resize(static_cast<Eigen::Index>(judges.size()));
  // The place of each support vector among those that are kept, in the order of the table.
  std::map<std::uint32_t, Eigen::Index> place;
  for (const Judge& judge : judges) {
    for (const std::uint32_t row : judge.rows) {
      place.emplace(row, 0);
    }
  }
  list.supports.resize(static_cast<Eigen::Index>(place.size()), features_.cols());
  Eigen::Index next = 0;
  for (auto& [row, at] : place) {
    list.supports.row(next) = features_.row(row);
    at = next++;
  }
  list.weights.setZero(static_cast<Eigen::Index>(judges.size()), next);
  for (std::size_t l = 0; l < judges.size(); ++l) {
    list.bias[static_cast<Eigen::Index>(l)] = judges[l].bias;
    list.support_vectors.push_back(static_cast<std::uint32_t>(judges[l].rows.size()));
    for (std::size_t s = 0; s < judges[l].rows.size(); ++s) {
      list.weights(static_cast<Eigen::Index>(l), place.at(judges[l].rows[s])) =
          static_cast<float>(judges[l].coefficients[s]);
    }
  }
  return list;
}

FeatureMatrix TrainingSet::margins_of_folded(std::span<const Judge> judges, std::span<const std::uint32_t> rows) const {
  const JudgeList folded = list(judges);
  FeatureMatrix margins = product_with_transposed<float>(FeatureMatrix(features_(rows, Eigen::all)), folded.weights);
  margins.rowwise() += folded.bias.transpose();
  return margins;
}

FeatureMatrix TrainingSet::margins(std::span<const Judge> judges, std::span<const std::uint32_t> rows) const {
  if (shared_gram_.empty()) {
    return margins_of_folded(judges, rows);
  }
  std::vector<std::uint32_t> supports;
  for (const Judge& judge : judges) {
    supports.insert(supports.end(), judge.rows.begin(), judge.rows.end());
  }
  std::ranges::sort(supports);
  supports.erase(std::ranges::unique(supports).begin(), supports.end());
  const Eigen::MatrixXf alike = kernel_between(kernel_, shared_gram_, rows, supports);
  FeatureMatrix margins(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(judges.size()));
  for (std::size_t l = 0; l < judges.size(); ++l) {
    Eigen::VectorXd sum = Eigen::VectorXd::Constant(margins.rows(), static_cast<double>(judges[l].bias));
    for (std::size_t s = 0; s < judges[l].rows.size(); ++s) {
      const auto at = std::ranges::lower_bound(supports, judges[l].rows[s]) - supports.begin();
      sum += judges[l].coefficients[s] * alike.col(at).cast<double>();
    }
    margins.col(static_cast<Eigen::Index>(l)) = sum.cast<float>();
  }
  return margins;
}

void JudgeList::put(std::size_t l, const FoldedJudge& judge) {
  const auto row = static_cast<Eigen::Index>(l);
  weights.row(row) = judge.weights;
  bias[row] = judge.bias;
  support_vectors[l] = judge.support_vectors;
}

std::vector<float> JudgeList::seen(std::span<const float> features) const {
  if (!codebook.empty()) {
    return codebook.count(features);
  }
  return whitening.empty() ? std::vector<float>(features.begin(), features.end()) : whitening.place(features);
}

FeatureMatrix JudgeList::margins(std::span<const std::span<const float>> objects) const {
  std::vector<std::vector<float>> all;
  for (const std::span<const float> object : objects) {
    all.push_back(seen(object));
  }
  return margins_on(all);
}

FeatureMatrix JudgeList::margins_on(std::span<const std::vector<float>> seen_features) const {
  std::vector<Eigen::VectorXf> inputs;  // of each object, what the weights are for
  for (const std::vector<float>& features : seen_features) {
    if (kernel.kind == KernelKind::linear) {
      inputs.emplace_back(
          Eigen::Map<const Eigen::VectorXf>(features.data(), static_cast<Eigen::Index>(features.size())));
    } else {
      inputs.push_back(kernel.row(supports, features));
    }
  }
  FeatureMatrix margins(static_cast<Eigen::Index>(inputs.size()), static_cast<Eigen::Index>(size()));
  constexpr Eigen::Index kJudgesAtOnce = 8;  // stay in the cache for all objects
  for (Eigen::Index first = 0; first < margins.cols(); first += kJudgesAtOnce) {
    const Eigen::Index last = std::min(first + kJudgesAtOnce, margins.cols());
    for (Eigen::Index i = 0; i < margins.rows(); ++i) {
      for (Eigen::Index l = first; l < last; ++l) {
        margins(i, l) = weights.row(l).dot(inputs[static_cast<std::size_t>(i)]) + bias[l];
      }
    }
  }
  return margins;
}

Ballot JudgeList::vote_on(std::span<const float> seen_features) const {
  const std::vector<float> one(seen_features.begin(), seen_features.end());
  const FeatureMatrix all = margins_on({&one, 1});
  return count_votes(categories, {all.data(), size()});
}

}  // namespace spincat
