#include "spincat/classify/evidence.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>

#include "spincat/classify/classify.h"
#include "spincat/classify/model_data.h"
#include "spincat/encode/encoding.h"
#include "spincat/spin/spin_images.h"
#include "spincat/train/train.h"
#include "support/shapes.h"
#include "support/temp_dir.h"

namespace spincat {
namespace {

Settings small_settings(const char* encoding, KernelKind kernel) {
  Settings settings = preset("default");
  settings.prepare.points = 300;
  settings.prepare.spin_points = 24;
  settings.spin.image_width = 8;
  settings.spin.bin_size = 0.25;
  settings.copies = 0;
  settings.words = 16;
  settings.encoding = encoding;
  settings.judge.kernel = kernel;
  settings.judge.dimensions = 0;
  settings.judge.c = default_c(settings.judge);
  settings.radial = false;
  settings.plain_samples = false;
  return settings;
}

// Boxes, cones and balls, three of each.
Model trained(const Settings& settings) {
  const test::TempDir dir;
  for (int k = 0; k < 3; ++k) {
    const double size = 1.0 + 0.1 * k;
    dir.write(fmt::format("shapes/box/{}.off", k), test::off_text(test::box(1, size, 1.2)));
    dir.write(fmt::format("shapes/cone/{}.off", k), test::off_text(test::cylinder(16, 0.6, 0.0, size)));
    dir.write(fmt::format("shapes/ball/{}.off", k), test::off_text(test::scaled(test::icosphere(2), size)));
  }
  return train(read_dataset({dir / "shapes"}), settings, {}).model;
}

Object new_object() {
  return test::cylinder(16, 0.5, 0.1, 1.1);
}

double sum_of(const Evidence& evidence) {
  double sum = 0.0;
  for (const PartEvidence& part : evidence.parts) {
    sum = std::accumulate(part.of_point.begin(), part.of_point.end(), sum);
  }
  return sum;
}

float pair_margin(const Ballot& ballot, std::uint32_t winner, std::uint32_t runner_up) {
  for (const Vote& vote : ballot.votes) {
    if (std::minmax(vote.category_a, vote.category_b) == std::minmax(winner, runner_up)) {
      return vote.category_a == winner ? vote.margin : -vote.margin;
    }
  }
  return std::nanf("");
}

TEST(Evidence, SharesAddUpToTheMarginOfWinnerAndRunnerUp) {
  for (const char* const encoding : {"pooled-pyramid", "mean-image", "concatenation"}) {
    Settings settings = small_settings(encoding, KernelKind::linear);
    settings.plain_samples = true;
    settings.up = UpAxis::z;
    settings.draws = 2;
    const Model model = trained(settings);
    const Classification found = classify(model, new_object());
    const Evidence evidence = explain(model, new_object(), found.ballot);
    EXPECT_EQ(evidence.kind, EvidenceKind::shares) << encoding;
    EXPECT_EQ(evidence.winner, found.ballot.winner);
    EXPECT_EQ(evidence.runner_up, found.ballot.runner_up);
    ASSERT_EQ(evidence.parts.size(), 6U) << encoding;  // three parts, two draws
    for (const PartEvidence& part : evidence.parts) {
      EXPECT_EQ(part.of_point.size(), part.prepared.preparation.object.spin_points.size());
    }
    EXPECT_EQ(evidence.margin, pair_margin(found.ballot, evidence.winner, evidence.runner_up));
    EXPECT_NEAR(sum_of(evidence), evidence.margin, 1e-4 * (1.0 + std::abs(evidence.margin))) << encoding;
  }
}

TEST(Evidence, LeavingOutIsWhatTheMarginFallsBy) {
  // Slowly, and by the public road only: all images but one, encoded and voted on again.
  const Settings settings = small_settings("mean-image", KernelKind::rbf);
  const Model model = trained(settings);
  const Classification found = classify(model, new_object());
  const Evidence evidence = explain(model, new_object(), found.ballot);
  ASSERT_EQ(evidence.kind, EvidenceKind::leaving_out);
  ASSERT_EQ(evidence.parts.size(), 1U);
  const auto& [object, params] = evidence.parts[0].prepared.preparation;
  const std::size_t count = object.spin_points.size();
  ASSERT_EQ(evidence.parts[0].of_point.size(), count);
  for (std::size_t left_out = 0; left_out < count; ++left_out) {
    OrientedPoints others(count - 1);
    for (std::size_t k = 0; k + 1 < count; ++k) {
      const std::size_t from = k < left_out ? k : k + 1;
      others.set(k, object.spin_points.position(from), object.spin_points.normal(from));
    }
    const auto sums = make_encoding("mean-image")->begin(object.surface, others, params);
    std::vector<double> values(sums->size(), 0.0);
    make_spin_images(object.surface, others, params,
                     [&](const SpinImageBlock& block) { sums->accumulate(block, values); });
    const Ballot without = model.data().judges.vote(sums->finish(values).values);
    EXPECT_NEAR(evidence.parts[0].of_point[left_out],
                evidence.margin - pair_margin(without, evidence.winner, evidence.runner_up), 1e-4);
  }
}

TEST(Evidence, EveryEncodingAndKernelIsExplained) {
  for (const char* const encoding : {"pooled-pyramid", "concatenation", "bag-of-features"}) {
    for (const KernelKind kernel : {KernelKind::linear, KernelKind::rbf}) {
      const Model model = trained(small_settings(encoding, kernel));
      const Ballot ballot = classify(model, new_object()).ballot;
      const Evidence evidence = explain(model, new_object(), ballot);
      const bool exact = kernel == KernelKind::linear && std::string(encoding) != "bag-of-features";
      EXPECT_EQ(evidence.kind, exact ? EvidenceKind::shares : EvidenceKind::leaving_out) << encoding;
      ASSERT_EQ(evidence.parts.size(), 1U);
      const std::vector<float>& values = evidence.parts[0].of_point;
      EXPECT_EQ(values.size(), 24U);
      EXPECT_TRUE(std::ranges::any_of(values, [](float value) { return value != 0.0F; })) << encoding;
      EXPECT_EQ(values, explain(model, new_object(), ballot).parts[0].of_point);
    }
  }
}

TEST(Evidence, OfManyPointsTheFirstAreLeftOut) {
  Settings settings = small_settings("mean-image", KernelKind::rbf);
  ModelData model = trained(settings).data();
  model.settings.prepare.points = 3000;
  model.settings.prepare.spin_points = static_cast<int>(kMostLeftOut) + 100;
  const Evidence evidence = explain(model, new_object(), classify(model, new_object()).ballot);
  EXPECT_EQ(evidence.parts[0].of_point.size(), kMostLeftOut);
  EXPECT_EQ(evidence.parts[0].prepared.preparation.object.spin_points.size(), kMostLeftOut + 100);
}

}  // namespace
}  // namespace spincat
