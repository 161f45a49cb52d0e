#include "spincat/classify/evidence.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include "spincat/classify/model_data.h"
#include "spincat/describe/training_copies.h"
#include "spincat/encode/block_sums.h"
#include "spincat/encode/encoding.h"
#include "spincat/spin/spin_images.h"

namespace spincat {
namespace {

// One part of the feature vector in one draw, and what its spin points say.
struct EncodedPart {
  std::unique_ptr<PreparedPart> prepared;  // at one place, as the encoder may look at it
  std::unique_ptr<Encoding::ObjectSums> encoder;
  std::vector<double> sums;
  std::vector<float> values;  // not yet multiplied by prepared->factor
  std::vector<float> evidence;

  const OrientedPoints& spin_points() const { return prepared->preparation.object.spin_points; }

  void for_each_block(const SpinImageConsumer& consume) const {
    make_spin_images(prepared->preparation.object.surface, spin_points(), prepared->preparation.params, consume);
  }

  // Its place in the whole feature vector.
  template <class T>
  std::span<T> place(std::span<T> whole) const {
    return whole.subspan(prepared->part * values.size(), values.size());
  }
};

EncodedPart encoded(PreparedPart prepared, const Encoding& encoding) {
  EncodedPart part;
  part.prepared = std::make_unique<PreparedPart>(std::move(prepared));
  const auto& [object, params] = part.prepared->preparation;
  part.encoder = encoding.begin(object.surface, object.spin_points, params);
  BlockSums sums(*part.encoder);
  part.for_each_block([&](const SpinImageBlock& block) { sums.add(block); });
  part.sums = sums.finish().total();
  part.values = part.encoder->finish(part.sums).values;
  return part;
}

// A margin that is weights . features + bias.
struct LinearMargin {
  Eigen::VectorXf weights;
  float bias = 0.0F;
};

// The judge of winner and runner-up by itself, signed in the winner's favour.
class PairJudge {
 public:
  PairJudge(const JudgeList& judges, const Ballot& ballot) : judges_(judges) {
    const auto [a, b] = std::minmax(ballot.winner, ballot.runner_up);
    std::size_t judge = 0;
    while (ballot.votes[judge].category_a != a || ballot.votes[judge].category_b != b) {
      ++judge;
    }
    const auto row = static_cast<Eigen::Index>(judge);
    sign_ = a == ballot.winner ? 1.0F : -1.0F;
    bias_ = sign_ * judges.bias[row];
    margin_ = sign_ * ballot.votes[judge].margin;
    if (is_linear()) {
      weights_ = sign_ * judges.weights.row(row).transpose();
    } else {
      keep_supports(judges, row);
    }
  }

  float margin_in_ballot() const { return margin_; }

  // Nothing where the margin is no weighted sum of features. With w the judge's weights in the small space, A its map,
  // c its middle and l the length of A x - c, which is held at what it is for the whole object, the margin is
  // (A^T w / l) . x - w . c / l + bias.
  std::optional<LinearMargin> linear_margin(std::span<const float> features) const {
    if (!is_linear() || !judges_.codebook.empty()) {
      return std::nullopt;
    }
    const Whitening& whitening = judges_.whitening;
    if (whitening.empty()) {
      return LinearMargin{weights_, bias_};
    }
    const float length = whitening.unscaled_place(features).norm();
    const float scale = length > 0.0F ? 1.0F / length : 0.0F;
    const std::vector<float> weights =
        whitening.columns.products({weights_.data(), static_cast<std::size_t>(weights_.size())});
    return LinearMargin{
        scale * Eigen::Map<const Eigen::VectorXf>(weights.data(), static_cast<Eigen::Index>(weights.size())),
        bias_ - scale * whitening.middle.transpose().dot(weights_)};
  }

  float margin(std::span<const float> features) const {
    const std::vector<float> seen = judges_.seen(features);
    if (is_linear()) {
      return weights_.dot(Eigen::Map<const Eigen::VectorXf>(seen.data(), weights_.size())) + bias_;
    }
    return weights_.dot(judges_.kernel.row(supports_, seen)) + bias_;
  }

 private:
  // Only those that this judge leans on.
  void keep_supports(const JudgeList& judges, Eigen::Index row) {
    std::vector<Eigen::Index> used;
    for (Eigen::Index s = 0; s < judges.weights.cols(); ++s) {
      if (judges.weights(row, s) != 0.0F) {
        used.push_back(s);
      }
    }
    supports_ = judges.supports(used, Eigen::all);
    weights_ = sign_ * judges.weights(row, used).transpose();
  }

  bool is_linear() const { return judges_.kernel.kind == KernelKind::linear; }

  const JudgeList& judges_;
  Eigen::VectorXf weights_;
  FeatureMatrix supports_;
  float sign_ = 1.0F;
  float bias_ = 0.0F;
  float margin_ = 0.0F;
};

// Each point's share of the margin; false where the encoding knows no shares. `bias`: a point's part of it.
bool contribution(const LinearMargin& margin, double bias, EncodedPart& part) {
  const std::span<const float> weights(margin.weights.data(), static_cast<std::size_t>(margin.weights.size()));
  std::vector<double> shares(part.spin_points().size(), 0.0);
  bool known = true;
  part.for_each_block([&](const SpinImageBlock& block) {
    known = known && part.encoder->add_contributions(block, part.sums, part.place(weights), shares);
  });
  for (std::size_t k = 0; known && k < shares.size(); ++k) {
    part.evidence.push_back(static_cast<float>(static_cast<double>(part.prepared->factor) * shares[k] + bias));
  }
  return known;
}

bool contribution(const LinearMargin& margin, std::span<EncodedPart> parts) {
  double points = 0.0;
  for (const EncodedPart& part : parts) {
    points += static_cast<double>(part.spin_points().size());
  }
  const double bias = static_cast<double>(margin.bias) / points;
  return std::ranges::all_of(parts, [&](EncodedPart& part) { return contribution(margin, bias, part); });
}

// By how much the margin falls without each of the first points of a part. `whole`: the object's feature vector.
void leave_out(const PairJudge& judge, const std::vector<float>& whole, EncodedPart& part) {
  const float with_all = judge.margin(whole);
  const float factor = part.prepared->factor;
  std::vector<float> changed = whole;
  const std::span<const float> before = part.place(std::span<const float>(whole));
  const std::span<float> after = part.place(std::span<float>(changed));
  part.for_each_block([&](const SpinImageBlock& block) {
    for (std::size_t k = 0; k < block.images.count() && part.evidence.size() < kMostLeftOut; ++k) {
      const std::vector<float> values = part.encoder->finish_without(block, k, part.sums).values;
      for (std::size_t j = 0; j < values.size(); ++j) {
        after[j] = before[j] + factor * (values[j] - part.values[j]);
      }
      part.evidence.push_back(with_all - judge.margin(changed));
    }
  });
}

}  // namespace

Evidence explain(const Model& model, const Object& object, const Ballot& ballot) {
  const PairJudge judge(model.data().judges, ballot);
  Evidence result{EvidenceKind::shares, ballot.winner, ballot.runner_up, judge.margin_in_ballot(), {}};
  const std::unique_ptr<Encoding> encoding = make_encoding(model.settings().encoding);
  const std::optional<Object> shown = shown_instead(object, model.settings());
  std::vector<EncodedPart> parts;
  std::vector<float> whole(model.feature_length(), 0.0F);
  for (PreparedPart& prepared : prepare_parts(shown ? *shown : object, model.settings())) {
    const EncodedPart& part = parts.emplace_back(encoded(std::move(prepared), *encoding));
    const std::span<float> place = part.place(std::span<float>(whole));
    std::ranges::transform(place, part.values, place.begin(),
                           [&](float sum, float value) { return sum + part.prepared->factor * value; });
  }
  const std::optional<LinearMargin> margin = judge.linear_margin(whole);
  if (!margin || !contribution(*margin, parts)) {
    result.kind = EvidenceKind::leaving_out;
    for (EncodedPart& part : parts) {
      leave_out(judge, whole, part);
    }
  }
  for (EncodedPart& part : parts) {
    result.parts.push_back({std::move(*part.prepared), std::move(part.evidence)});
  }
  return result;
}

}  // namespace spincat
