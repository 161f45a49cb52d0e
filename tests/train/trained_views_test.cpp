// Judges that are trained by rendered views.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "spincat/camera/render/views.h"
#include "spincat/classify/classify.h"
#include "spincat/classify/model_data.h"
#include "spincat/dataset/dataset.h"
#include "spincat/describe/kinds.h"
#include "spincat/evaluate/evaluate.h"
#include "spincat/files/file.h"
#include "spincat/parallel/task_farm.h"
#include "spincat/train/train.h"
#include "support/copies.h"
#include "support/expect_error.h"
#include "support/tiny_dataset.h"

namespace spincat {
namespace {

using test::input_error;
using test::TempDir;

Settings view_settings(int views) {
  return trained_by_views(test::tiny_settings(), views);
}

class Views : public testing::Test {
 protected:
  Views() { test::write_tiny_shapes(dir_, "shapes", 4); }

  Dataset shapes() const { return read_dataset({dir_ / "shapes"}); }

  TempDir dir_;
};

TEST(TaughtByViews, GivesARowForEachView) {
  const Settings settings = view_settings(7);
  EXPECT_EQ(settings.training_rows(), 7);
  EXPECT_EQ(settings.tested_rows(), 7);
  EXPECT_EQ(settings.up, UpAxis::y);
  settings.validate();
  EXPECT_EQ(test::tiny_settings().tested_rows(), 1);
  Settings lying = settings;
  lying.up = UpAxis::none;
  EXPECT_NE(input_error([&] { lying.validate(); }).find("which axis points up"), std::string::npos);
}

TEST(DescribeViews, EachViewAndEachMeshIsSeenFromAnotherPlace) {
  const Settings settings = view_settings(3);
  const auto values = [&](const Object& object, int view) {
    return test::describe_copy(object, settings, view).values;
  };
  const Object box = test::box(1, 2, 3);
  EXPECT_EQ(values(box, 0), values(box, 0));
  EXPECT_NE(values(box, 0), values(box, 1));
  Mesh moved = test::box(1, 2, 3);
  for (Vec3& v : moved.vertices) {
    v.x() += 1.0;
  }
  EXPECT_NE(values(moved, 0), values(box, 0));
  Settings other = settings;
  other.seed = 2;
  EXPECT_NE(test::describe_copy(box, other, 0).values, values(box, 0));
}

TEST(DescribeViews, ACloudIsAViewAlready) {
  Settings settings = view_settings(3);
  const PointCloud cloud = view_of(test::box(1, 2, 3), {}, 5);
  const std::vector<float> seen = describe(cloud, settings).values;
  // The same as a cloud among others, but for the axis that points up: z, whichever it is in models.
  settings.trained_for = TrainedFor::any;
  settings.up = UpAxis::z;
  EXPECT_EQ(describe(cloud, settings).values, seen);
}

TEST(DescribeViews, FollowTheModelsOwnUpAxis) {
  // The same tower, standing along y and along z.
  Settings settings = view_settings(1);
  const auto height_of = [&](const Mesh& mesh) {
    const PreparedObject prepared = test::prepare_copy(mesh, settings, 0).object;
    float low = 0.0F;
    float high = 0.0F;
    for (std::size_t i = 0; i < prepared.surface.size(); ++i) {
      low = std::min(low, prepared.surface.position(i).z());
      high = std::max(high, prepared.surface.position(i).z());
    }
    return high - low;
  };
  EXPECT_GT(height_of(test::box(1, 4, 1)), 1.5F);
  EXPECT_LT(height_of(test::box(1, 1, 4)), 1.2F);
  settings.up = UpAxis::z;
  EXPECT_GT(height_of(test::box(1, 1, 4)), 1.5F);
}

TEST_F(Views, TrainedJudgesNameNewViews) {
  const Model model = train(shapes(), view_settings(4), {.threads = 2}).model;
  EXPECT_EQ(model.meshes(), 12U);
  EXPECT_EQ(model.clouds(), 0U);
  EXPECT_TRUE(model.tells_strangers());
  EXPECT_EQ(model.data().judges.whitening.input_length(), model.feature_length());
  int right = 0;
  for (std::uint32_t category = 0; category < 3; ++category) {
    for (int k = 0; k < 4; ++k) {
      const PointCloud view = view_of(test::tiny_shape(model.categories()[category], 2), {}, 100 + k);
      const Classification named = classify(model, view);
      EXPECT_EQ(named.kind_mismatch, "");
      right += named.ballot.winner == category ? 1 : 0;
    }
  }
  EXPECT_GE(right, 10);  // of 12
}

TEST_F(Views, TheModelDoesNotDependOnThreads) {
  const auto bytes = [&](int threads) {
    write_model(dir_ / "m.spincat", train(shapes(), view_settings(3), {.threads = threads}).model);
    return read_file(dir_ / "m.spincat");
  };
  EXPECT_EQ(bytes(1), bytes(3));
}

TEST_F(Views, EvaluationSumsVotesOverViews) {
  EvaluateOptions options;
  options.leave_one_out = true;
  const Evaluation found = evaluate(shapes(), view_settings(5), options);
  ASSERT_EQ(found.views.size(), 4U);  // 1, 2, 4 and all
  EXPECT_EQ(found.views[0].views, 1U);
  EXPECT_EQ(found.views[2].views, 4U);
  EXPECT_EQ(found.views[3].views, 5U);
  EXPECT_EQ(found.views[3].mean_class_rate, found.mean_class_rate.mean);
  EXPECT_GT(found.views[0].overall_rate, 0.7);
  for (const TestedObject& object : found.tested) {
    EXPECT_EQ(object.named.size(), 1U);  // one name, of all its views
  }
  const Evaluation whole = evaluate(shapes(), test::tiny_settings(), options);
  EXPECT_TRUE(whole.views.empty());
}

TEST_F(Views, EvaluationAcrossRendersTheTestedObjects) {
  test::write_tiny_shapes(dir_, "others", 2, 4);
  const Evaluation found = evaluate_across(shapes(), read_dataset({dir_ / "others"}), view_settings(3), {});
  ASSERT_EQ(found.tested.size(), 6U);
  EXPECT_EQ(found.views.size(), 3U);
  EXPECT_GE(found.overall_rate.mean, 0.66);
  EXPECT_EQ(found.kind_mismatch, "");
}

TEST_F(Views, EvaluationTestsViewsInNoOtherForm) {
  EvaluateOptions options;
  options.test.form = TestForm::cloud;
  EXPECT_NE(input_error([&] { evaluate(shapes(), view_settings(2), options); }).find("trained by views"),
            std::string::npos);
}

TEST_F(Views, EvaluationTellsOfClouds) {
  EvaluateOptions options;
  options.splits = 1;
  options.test.form = TestForm::cloud;
  Settings meshes = test::tiny_settings();
  meshes.trained_for = TrainedFor::meshes;
  EXPECT_NE(evaluate(shapes(), meshes, options).kind_mismatch.find("is a point cloud"), std::string::npos);
  Settings any = test::tiny_settings();
  any.trained_for = TrainedFor::any;
  EXPECT_EQ(evaluate(shapes(), any, options).kind_mismatch, "");
}

TEST(Misfit, IsWhatTheJudgesNeverMet) {
  const KindCounts meshes{5, 0};
  const KindCounts clouds{0, 5};
  const KindCounts both{5, 5};
  EXPECT_EQ(kind_mismatch(ObjectKind::mesh, meshes, TrainedFor::meshes), "");
  EXPECT_EQ(kind_mismatch(ObjectKind::cloud, clouds, TrainedFor::meshes), "");
  EXPECT_EQ(kind_mismatch(ObjectKind::cloud, both, TrainedFor::meshes), "");
  EXPECT_NE(kind_mismatch(ObjectKind::cloud, meshes, TrainedFor::meshes), "");
  EXPECT_NE(kind_mismatch(ObjectKind::mesh, clouds, TrainedFor::meshes), "");
  EXPECT_EQ(kind_mismatch(ObjectKind::cloud, meshes, TrainedFor::any), "");
  EXPECT_EQ(kind_mismatch(ObjectKind::mesh, clouds, TrainedFor::any), "");
  EXPECT_EQ(kind_mismatch(ObjectKind::cloud, meshes, TrainedFor::views), "");
  EXPECT_NE(kind_mismatch(ObjectKind::mesh, meshes, TrainedFor::views), "");
}

}  // namespace
}  // namespace spincat
