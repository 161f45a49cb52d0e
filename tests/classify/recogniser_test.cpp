// The road from depth frames to names.
#include "spincat/classify/recogniser.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <map>
#include <numbers>

#include "spincat/camera/render/sensor_noise.h"
#include "spincat/report/camera_report.h"
#include "spincat/train/train.h"
#include "support/expect_error.h"
#include "support/scenes.h"
#include "support/tiny_dataset.h"

namespace spincat {
namespace {

using test::moved;
using test::Scene;

const Model& views_model() {
  static const Model model = [] {
    const test::TempDir dir;
    test::write_tiny_shapes(dir, "shapes", 4);
    Settings settings = trained_by_views(test::tiny_settings(), 6);
    settings.up = UpAxis::z;
    return train(read_dataset({dir / "shapes"}), settings, {.threads = 2}).model;
  }();
  return model;
}

// A box and a cone on a table, the latter at the given place.
Scene box_and_cone(double box_x = -0.15, double cone_x = 0.15) {
  Scene scene;
  scene.things = {moved(test::box(0.18, 0.18, 0.2), {box_x, 0.0, 0.1}),
                  moved(test::cylinder(32, 0.12, 0.0, 0.2), {cone_x, 0.0, 0.0})};
  return scene;
}

DepthImage noisy(const Scene& scene, std::uint64_t seed) {
  DepthImage image = scene.picture();
  Random random(seed);
  add_sensor_noise(scene.intrinsics, 1.0, random, image);
  return image;
}

DepthImage times(DepthImage image, float factor) {
  for (float& z : image.depth) {
    z *= factor;
  }
  return image;
}

// By the object's category: what it was named, over its last frames.
std::map<std::string, std::uint64_t> ids_by_name(const SeenFrame& frame) {
  std::map<std::string, std::uint64_t> ids;
  for (const SeenObject& object : frame.objects) {
    ids[views_model().categories()[object.fused.winner]] = object.id;
  }
  return ids;
}

std::string json_without_times(const SeenFrame& frame) {
  const std::string json = frame_json({}, frame, views_model().categories());
  const std::size_t from = json.find("\"milliseconds\"");
  return json.substr(0, from) + json.substr(json.find('}', from));
}

TEST(Recogniser, NamesWhatStandsOnATable) {
  Recogniser recogniser(views_model(), {}, 1);
  const SeenFrame frame = recogniser.look(noisy(box_and_cone(), 1), Intrinsics{});
  EXPECT_EQ(frame.status, FrameStatus::objects);
  ASSERT_EQ(frame.objects.size(), 2U);
  const auto ids = ids_by_name(frame);
  EXPECT_TRUE(ids.contains("box"));
  EXPECT_TRUE(ids.contains("cone"));
  for (const SeenObject& object : frame.objects) {
    EXPECT_EQ(object.problem, "");
    EXPECT_EQ(object.fused.winner, object.ballot.winner);
    EXPECT_EQ(object.fused_confidence, object.confidence);
    EXPECT_NEAR(object.distance, 1.0F, 0.15F);
    EXPECT_FALSE(object.unknown);
  }
}

TEST(Recogniser, SaysTheSameWithAnyNumberOfThreads) {
  Recogniser one(views_model(), {}, 1);
  Recogniser three(views_model(), {}, 3);
  for (int k = 0; k < 4; ++k) {
    const DepthImage image = noisy(box_and_cone(-0.15 + 0.02 * k), 1);
    EXPECT_EQ(json_without_times(one.look(image, Intrinsics{})), json_without_times(three.look(image, Intrinsics{})));
  }
}

TEST(Recogniser, ObjectsThatSwapPlacesKeepTheirVotes) {
  Recogniser recogniser(views_model(), {}, 1);
  std::map<std::string, std::uint64_t> first;
  constexpr int kFrames = 21;
  for (int k = 0; k < kFrames; ++k) {
    // Half a turn around each other.
    const double angle = std::numbers::pi * k / (kFrames - 1);
    const double x = 0.18 * std::cos(angle);
    const double y = 0.18 * std::sin(angle);
    Scene scene;
    scene.things = {moved(test::box(0.18, 0.18, 0.2), {-x, -y, 0.1}),
                    moved(test::cylinder(32, 0.12, 0.0, 0.2), {x, y, 0.0})};
    const SeenFrame frame = recogniser.look(noisy(scene, 7 + k), scene.intrinsics);
    ASSERT_EQ(frame.objects.size(), 2U) << k;
    const auto ids = ids_by_name(frame);
    ASSERT_EQ(ids.size(), 2U) << k;
    first = k == 0 ? ids : first;
    EXPECT_EQ(ids, first) << k;
  }
}

TEST(Recogniser, SumsVotesOverTheLastFramesOnly) {
  RecogniserSettings settings;
  settings.summed_frames = 3;
  Recogniser recogniser(views_model(), settings, 1);
  for (int k = 1; k <= 5; ++k) {
    const SeenFrame frame = recogniser.look(noisy(box_and_cone(), k), Intrinsics{});
    ASSERT_EQ(frame.objects.size(), 2U);
    EXPECT_EQ(frame.objects[0].fused.ballots, static_cast<std::uint32_t>(std::min(k, 3)));
  }
}

TEST(Recogniser, RejectsWhatItIsNotSureOf) {
  RecogniserSettings settings;
  settings.reject = 1.0;  // no confidence reaches it
  Recogniser recogniser(views_model(), settings, 1);
  const SeenFrame frame = recogniser.look(noisy(box_and_cone(), 1), Intrinsics{});
  ASSERT_EQ(frame.objects.size(), 2U);
  EXPECT_TRUE(frame.objects[0].unknown);
  const std::string json = frame_json({}, frame, views_model().categories());
  EXPECT_NE(json.find("\"status\":\"unknown\""), std::string::npos);
  EXPECT_NE(json.find("\"best_guess\""), std::string::npos);
}

TEST(Recogniser, SaysWhyThereIsNothing) {
  Recogniser recogniser(views_model(), {}, 1);
  const auto looked = [&](const DepthImage& image) { return recogniser.look(image, Intrinsics{}); };
  Scene empty;
  EXPECT_EQ(looked(noisy(empty, 1)).status, FrameStatus::empty_table);
  EXPECT_EQ(why_nothing(looked(empty.picture())), "nothing on the table");
  EXPECT_EQ(looked(DepthImage(640, 480)).status, FrameStatus::few_readings);
  EXPECT_EQ(looked(DepthImage(1, 1)).status, FrameStatus::few_readings);
  DepthImage speckled(640, 480);  // readings all over the room: no plane
  Random random(1);
  for (float& z : speckled.depth) {
    z = static_cast<float>(random.uniform(0.5, 4.0));
  }
  const SeenFrame nowhere = looked(speckled);
  EXPECT_EQ(nowhere.status, FrameStatus::no_table);
  EXPECT_FALSE(nowhere.table);
  EXPECT_TRUE(nowhere.objects.empty());
  // Millimetres taken for metres, and metres for millimetres.
  const SeenFrame far = looked(times(box_and_cone().picture(), 1000.0F));
  EXPECT_EQ(far.status, FrameStatus::wrong_units);
  EXPECT_NE(why_nothing(far).find("--units"), std::string::npos);
  EXPECT_EQ(looked(times(box_and_cone().picture(), 0.001F)).status, FrameStatus::wrong_units);
  // And goes on.
  EXPECT_EQ(looked(noisy(box_and_cone(), 1)).objects.size(), 2U);
}

TEST(Recogniser, PassesOverDepthsThatAreNone) {
  const DepthImage sound = noisy(box_and_cone(), 1);
  DepthImage spoilt = sound;
  DepthImage without = sound;
  const float kNone[] = {1e-30F, 1e-6F, -1.0F, 1e30F, std::numeric_limits<float>::quiet_NaN()};
  for (std::size_t i = 0; i < spoilt.depth.size(); i += 97) {
    spoilt.depth[i] = kNone[i % 5];
    without.depth[i] = 0.0F;
  }
  const SeenFrame a = Recogniser(views_model(), {}, 1).look(spoilt, {});
  const SeenFrame b = Recogniser(views_model(), {}, 1).look(without, {});
  EXPECT_EQ(a.segmentation.ids, b.segmentation.ids);
  EXPECT_EQ(a.objects.size(), 2U);
}

TEST(Recogniser, SaysWhatIsTooSmall) {
  Scene scene;
  scene.things = {moved(test::box(0.012, 0.012, 0.03), {0.0, 0.0, 0.015})};
  Recogniser recogniser(views_model(), {}, 1);
  const SeenFrame frame = recogniser.look(scene.picture(), scene.intrinsics);
  EXPECT_EQ(frame.status, FrameStatus::empty_table);
  EXPECT_GT(frame.segmentation.left_out.too_few, 20U);
  EXPECT_NE(why_nothing(frame).find("too small"), std::string::npos);
}

TEST(Recogniser, TellsAnObjectThatThePictureCuts) {
  Scene scene;
  scene.things = {moved(test::box(0.3, 0.2, 0.2), {-0.5, 0.0, 0.1})};
  Recogniser recogniser(views_model(), {}, 1);
  const SeenFrame frame = recogniser.look(scene.picture(), scene.intrinsics);
  ASSERT_EQ(frame.objects.size(), 1U);
  EXPECT_TRUE(frame.objects[0].segment.cut);
  EXPECT_EQ(frame.objects[0].problem, "");  // and is named all the same
}

TEST(Recogniser, DoesNotMindACameraThatIsRolled) {
  // The same scene with rows and columns changed: a camera turned by 90 degrees about its axis, and mirrored.
  const DepthImage upright = noisy(box_and_cone(), 1);
  DepthImage rolled(upright.height, upright.width);
  for (int v = 0; v < upright.height; ++v) {
    for (int u = 0; u < upright.width; ++u) {
      rolled.depth[rolled.index(upright.height - 1 - v, u)] = upright.at(u, v);
    }
  }
  Intrinsics turned;
  std::swap(turned.cx, turned.cy);
  turned.cx = upright.height - 1 - turned.cx;
  Recogniser recogniser(views_model(), {}, 1);
  const SeenFrame frame = recogniser.look(rolled, turned);
  ASSERT_EQ(frame.objects.size(), 2U);
  EXPECT_EQ(ids_by_name(frame).size(), 2U);
  EXPECT_NEAR(frame.table->offset, 0.7F, 0.01F);
  // With what is up for it.
  RecogniserSettings settings;
  const Eigen::AngleAxisf turn(std::numbers::pi_v<float> / 2.0F, Eigen::Vector3f::UnitZ());
  const Eigen::Vector3f up = turn * box_and_cone().table().normal;
  settings.table.up = up;
  EXPECT_EQ(Recogniser(views_model(), settings, 1).look(rolled, turned).objects.size(), 2U);
  settings.table.up = Eigen::Vector3f(-up);  // what lies overhead is no table
  EXPECT_EQ(Recogniser(views_model(), settings, 1).look(rolled, turned).status, FrameStatus::no_table);
}

TEST(Recogniser, RefusesSettingsOutOfRange) {
  RecogniserSettings settings;
  settings.reject = 1.5;
  EXPECT_NE(test::input_error([&] { Recogniser(views_model(), settings, 1); }).find("1.5"), std::string::npos);
  settings = {};
  settings.table.up = Eigen::Vector3f::Zero();
  EXPECT_NE(test::input_error([&] { settings.validate(); }).find("up"), std::string::npos);
  settings = {};
  settings.summed_frames = 0;
  EXPECT_NE(test::input_error([&] { settings.validate(); }).find("summed"), std::string::npos);
}

TEST(TimeHistogram, GivesPercentilesOfMillionsInBoundedMemory) {
  TimeHistogram times;
  EXPECT_EQ(times.percentile(0.5), 0.0);
  for (int k = 1; k <= 1000; ++k) {
    times.add(1e-3 * k);
  }
  EXPECT_EQ(times.count(), 1000U);
  EXPECT_NEAR(times.percentile(0.5), 0.5, 0.006);
  EXPECT_GE(times.percentile(0.99), 0.99);
  EXPECT_LE(times.percentile(0.99), 1.0);
  EXPECT_EQ(times.percentile(1.0), 1.0);
  EXPECT_EQ(times.longest(), 1.0);
  times.add(-1.0);
  times.add(1e9);  // beyond the bins
  EXPECT_EQ(times.longest(), 1e9);
}

}  // namespace
}  // namespace spincat
