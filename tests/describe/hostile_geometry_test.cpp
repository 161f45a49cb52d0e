// The whole road on hostile but readable geometry: finite features and a valid ballot, or a refusal in words.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "spincat/classify/classify.h"
#include "spincat/classify/recogniser.h"
#include "spincat/describe/describe.h"
#include "spincat/evaluate/evaluate.h"
#include "spincat/spin/spin_images.h"
#include "spincat/train/train.h"
#include "support/copies.h"
#include "support/expect_error.h"
#include "support/hostile.h"
#include "support/scenes.h"
#include "support/tiny_dataset.h"

namespace spincat {
namespace {

using test::HostileObject;
using test::input_error;

// Every way to a feature vector: presets, encodings, kinds of surface, what the judges are trained for.
std::map<std::string, Settings> all_settings() {
  const Settings tiny = test::tiny_settings();
  std::map<std::string, Settings> all = {{"default", tiny}};
  all["paper"] = preset("paper");
  all["paper"].copies = 1;
  all["any"] = tiny;
  all["any"].trained_for = TrainedFor::any;
  all["any"].plain_samples = true;
  all["any"].draws = 2;
  all["up"] = tiny;
  all["up"].up = UpAxis::z;
  all["mean image"] = tiny;
  all["mean image"].encoding = "mean-image";
  all["mean image"].spin.angle_test = AngleTest::cutoff;
  all["views"] = trained_by_views(tiny, 2);
  all["views"].up = UpAxis::z;
  return all;
}

bool all_finite(std::span<const float> values) {
  return std::ranges::all_of(values, [](float v) { return std::isfinite(v); });
}

// As PCL writes it.
std::string pcd_text(const PointCloud& cloud) {
  const bool has_normals = !cloud.normals.empty();
  const Vec3 sensor = cloud.sensor.value_or(Vec3::Zero());
  std::string text = fmt::format(
      "VERSION .7\nFIELDS x y z{}\nSIZE 8 8 8{}\nTYPE F F F{}\nPOINTS {}\nVIEWPOINT {} {} {} 1 0 0 0\nDATA ascii\n",
      has_normals ? " normal_x normal_y normal_z" : "", has_normals ? " 8 8 8" : "", has_normals ? " F F F" : "",
      cloud.points.size(), sensor.x(), sensor.y(), sensor.z());
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const Vec3& p = cloud.points[i];
    text += fmt::format("{} {} {}", p.x(), p.y(), p.z());
    if (has_normals) {
      const Vec3& n = cloud.normals[i];
      text += fmt::format(" {} {} {}", n.x(), n.y(), n.z());
    }
    text += "\n";
  }
  return text;
}

bool is_large(const Object& object) {
  const auto* mesh = std::get_if<Mesh>(&object);
  return (mesh != nullptr ? mesh->vertices : std::get<PointCloud>(object).points).size() > 100'000;
}

const Model& model_for(const std::string& name) {
  static std::map<std::string, Model> models;
  if (!models.contains(name)) {
    const test::TempDir dir;
    test::write_tiny_shapes(dir, "shapes", 3);
    models.emplace(name, train(read_dataset({dir / "shapes"}), all_settings().at(name), {.threads = 2}).model);
  }
  return models.at(name);
}

void expect_valid(const Classification& answer, std::size_t categories, const std::string& what) {
  const Ballot& ballot = answer.ballot;
  ASSERT_EQ(ballot.votes.size(), categories * (categories - 1) / 2) << what;
  std::uint32_t votes = 0;
  for (const std::uint32_t count : ballot.count) {
    votes += count;
  }
  EXPECT_EQ(votes, ballot.votes.size()) << what;
  EXPECT_LT(ballot.winner, categories) << what;
  EXPECT_NE(ballot.winner, ballot.runner_up) << what;
  EXPECT_TRUE(all_finite(ballot.margin_sum)) << what;
  EXPECT_GT(answer.confidence, 0.0) << what;  // NaN is not
  EXPECT_LT(answer.confidence, 1.0) << what;
}

class Hostile : public testing::TestWithParam<std::string> {};

TEST_P(Hostile, GeometryGivesFiniteFeaturesAndAValidBallotOrIsRefused) {
  const Settings settings = all_settings().at(GetParam());
  const Model& model = model_for(GetParam());
  for (const HostileObject& it : test::hostile_objects()) {
    const std::string what = GetParam() + ": " + it.name;
    SCOPED_TRACE(what);
    if (is_large(it.object) && GetParam() != "default" && GetParam() != "paper") {
      continue;  // it takes its time, and what makes it small comes first everywhere
    }
    if (it.refused) {
      EXPECT_NE(input_error([&] { classify(model, it.object); }), "no error");
      continue;
    }
    std::string problem;  // a camera may look past a thin object: that is a word, too
    try {
      for (const int row : {0, settings.training_rows() - 1}) {
        EXPECT_TRUE(all_finite(test::describe_copy(it.object, settings, row).values)) << "row " << row;
      }
      expect_valid(classify(model, it.object), model.categories().size(), what);
    } catch (const InputError& error) {
      problem = error.what();
    }
    EXPECT_TRUE(problem.empty() || settings.trained_for == TrainedFor::views) << problem;
  }
}

TEST_P(Hostile, GeometryAmongTheTrainingObjectsTrainsFiniteJudges) {
  Settings settings = all_settings().at(GetParam());
  const test::TempDir dir;
  test::write_tiny_shapes(dir, "shapes", 4);
  std::size_t refused = 0;
  for (const HostileObject& it : test::hostile_objects()) {
    if (is_large(it.object)) {
      continue;
    }
    refused += it.refused ? 1 : 0;
    if (const auto* mesh = std::get_if<Mesh>(&it.object)) {
      dir.write("shapes/hostile mesh/" + it.name + ".off", test::off_text(*mesh));
    } else {
      dir.write("shapes/hostile cloud/" + it.name + ".pcd", pcd_text(std::get<PointCloud>(it.object)));
    }
  }
  const Dataset dataset = read_dataset({dir / "shapes"});
  const TrainResult result = train(dataset, settings, {.threads = 2});
  if (settings.trained_for != TrainedFor::views) {
    EXPECT_EQ(result.skipped.size(), refused);
  }
  write_model(dir / "x.spincat", result.model);
  const Model model = read_model(dir / "x.spincat");  // which looks at every number
  expect_valid(classify(model, test::box()), 5, GetParam());
  EvaluateOptions options;
  options.splits = 2;
  options.measure_confidence = true;
  const Evaluation evaluation = evaluate(dataset, settings, options, {.threads = 2});
  EXPECT_TRUE(std::isfinite(evaluation.mean_class_rate.mean));
  EXPECT_TRUE(std::isfinite(evaluation.confidence->right_or_wrong));
  EXPECT_TRUE(std::isfinite(evaluation.confidence->mean_confidence));
}

INSTANTIATE_TEST_SUITE_P(Settings, Hostile, testing::Values("default", "paper", "any", "up", "mean image", "views"),
                         [](const auto& test) {
                           std::string name = test.param;
                           std::erase(name, ' ');
                           return name;
                         });

TEST(HostileSpinImages, AreFinite) {
  for (const SpinConvention convention : {SpinConvention::johnson, SpinConvention::pcl}) {
    Settings settings = preset("paper");
    settings.spin.convention = convention;
    settings.spin.support_angle = convention == SpinConvention::pcl ? 90.0 : 180.0;
    for (const HostileObject& it : test::hostile_objects()) {
      if (it.refused) {
        EXPECT_NE(input_error([&] { prepare_object(it.object, settings); }), "no error") << it.name;
        continue;
      }
      const Preparation made = prepare_object(it.object, settings);
      const auto look = [&](const SpinImageBlock& block) { EXPECT_TRUE(all_finite(block.images.values())) << it.name; };
      make_spin_images(made.object.surface, made.object.spin_points, made.params, look, 1);
    }
  }
}

// Pictures that no camera takes.
std::map<std::string, DepthImage> hostile_pictures() {
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  test::Scene scene;
  scene.things = {test::moved(test::box(0.2, 0.2, 0.2), {0, 0, 0.1})};
  const DepthImage sound = scene.picture();
  std::map<std::string, DepthImage> pictures = {{"no pixels", DepthImage(0, 0)}, {"one pixel", DepthImage(1, 1)}};
  const auto painted = [&](auto depth_of) {
    DepthImage image = sound;
    for (std::size_t i = 0; i < image.depth.size(); ++i) {
      image.depth[i] = depth_of(i, image.depth[i]);
    }
    return image;
  };
  for (const float value : {0.0F, 1.0F, -1.0F, 1e30F, 1e-30F, kNaN, kInfinity}) {
    pictures[fmt::format("all {}", value)] = painted([&](std::size_t, float) { return value; });
    pictures[fmt::format("every third {}", value)] =
        painted([&](std::size_t i, float z) { return i % 3 == 0 ? value : z; });
  }
  Random random(3);
  pictures["noise"] = painted([&](std::size_t, float) { return static_cast<float>(random.uniform(0.4, 4.0)); });
  pictures["stripes"] = painted([](std::size_t i, float z) { return i % 640 / 8 % 2 == 0 ? z : 0.5F * z; });
  return pictures;
}

TEST(HostilePictures, GiveFiniteAnswers) {
  for (const SegmentSplit split : {SegmentSplit::none, SegmentSplit::concave}) {
    for (const auto& [name, picture] : hostile_pictures()) {
      SCOPED_TRACE(name);
      RecogniserSettings settings;
      settings.segment.split = split;
      Recogniser recogniser(model_for("views"), settings, 1);
      const SeenFrame frame = recogniser.look(picture, Intrinsics{});
      EXPECT_TRUE(std::isfinite(frame.median_depth));
      for (const SeenObject& object : frame.objects) {
        EXPECT_TRUE(std::isfinite(object.distance));
        EXPECT_TRUE(object.segment.centre.allFinite());
        EXPECT_TRUE(std::isfinite(object.segment.height));
        EXPECT_TRUE(!object.problem.empty() || std::isfinite(object.fused_confidence));
      }
    }
  }
}

}  // namespace
}  // namespace spincat
