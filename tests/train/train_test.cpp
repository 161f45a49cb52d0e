#include "spincat/train/train.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>

#include "spincat/classify/classify.h"
#include "spincat/classify/model_data.h"
#include "spincat/dataset/dataset.h"
#include "spincat/evaluate/evaluate.h"
#include "spincat/files/file.h"
#include "spincat/geometry/random.h"
#include "spincat/io/read_object.h"
#include "spincat/parallel/task_farm.h"
#include "spincat/prepare/as_cloud.h"
#include "spincat/train/broadcast_table.h"
#include "spincat/train/describe_dataset.h"
#include "spincat/train/judge_trainer.h"
#include "spincat/train/learned_space.h"
#include "support/copies.h"
#include "support/expect_error.h"
#include "support/shapes.h"
#include "support/temp_dir.h"

namespace spincat {
namespace {

using test::input_error;
using test::TempDir;

constexpr int kShapesEach = 6;

// Shape number `k` of a kind: in proportions, place, unit and attitude of its own.
Mesh shape_of(const std::string& kind, int k) {
  Random random(derive_seed(kind.size() + static_cast<std::uint64_t>(kind[0]), static_cast<std::uint64_t>(k)));
  const double wide = random.uniform(0.8, 1.25);
  Mesh mesh = kind == "box"       ? test::box(1, wide, random.uniform(0.8, 1.25))
              : kind == "ball"    ? test::icosphere(2)
              : kind == "spindle" ? test::cylinder(24, 0.12 * wide, 0.12 * wide, 2.0)
                                  : test::cylinder(24, wide, 0.0, 1.2);
  if (kind == "ball") {
    for (Vec3& v : mesh.vertices) {
      v.x() *= wide;
    }
  }
  const Eigen::Quaterniond turn(random.normal(), random.normal(), random.normal(), random.normal());
  mesh = test::turned(mesh, turn.normalized());
  const Vec3 place(random.normal(), random.normal(), random.normal());
  const double unit = std::exp(random.uniform(-5, 5));
  for (Vec3& v : mesh.vertices) {
    v = unit * (v + place);
  }
  return mesh;
}

// Written once for all tests: DIR/kind/kind0.off, ...
const std::filesystem::path& shapes_folder() {
  static const TempDir dir;
  static const bool written = [] {
    for (const char* kind : {"box", "ball", "cone", "spindle"}) {
      for (int k = 0; k < kShapesEach; ++k) {
        dir.write(fmt::format("{0}/{0}{1}.off", kind, k), test::off_text(shape_of(kind, k)));
      }
    }
    return true;
  }();
  static_cast<void>(written);
  return dir.path();
}

Dataset shapes() {
  return read_dataset({shapes_folder()});
}

Settings small_settings(const char* name = "default") {
  Settings settings = preset(name);
  settings.prepare.points = 300;
  settings.prepare.spin_points = 48;
  settings.spin.image_width = 8;
  settings.spin.bin_size = 0.25;
  settings.radial = false;
  settings.plain_samples = false;
  settings.copies = std::min(settings.copies, 1);
  settings.background = std::min(settings.background, 12);
  return settings;
}

std::string model_bytes(const Model& model) {
  const TempDir dir;
  write_model(dir / "m.spincat", model);
  return read_file(dir / "m.spincat");
}

Evaluation evaluated(const Settings& settings, int threads) {
  EvaluateOptions options;
  options.splits = 3;
  return evaluate(shapes(), settings, options, {.threads = threads});
}

TEST(Describe, AStretchedCopyIsAnother) {
  const Object object = test::box();
  const Settings settings = small_settings();
  EXPECT_EQ(describe(object, settings).values, describe(object, settings).values);
  EXPECT_NE(describe(object, settings).values, test::describe_copy(object, settings, 1).values);
  EXPECT_NE(test::describe_copy(object, settings, 2).values, test::describe_copy(object, settings, 1).values);
  Settings other = settings;
  other.seed = 2;
  EXPECT_NE(describe(object, settings).values, describe(object, other).values);
}

TEST(Describe, ATurnChangesLessThanAnotherShape) {
  // Feature vectors have length 1. Of a turned shape other points are seen and drawn, which moves the vector by the
  // noise of sampling, 0.05 to 0.16 as measured here; shapes of two of these kinds are 0.56 and more apart.
  const Settings settings = preset("default");
  const auto vector_of = [&](const Mesh& mesh) {
    const std::vector<float> values = describe(mesh, settings).values;
    return Eigen::VectorXf(Eigen::Map<const Eigen::VectorXf>(values.data(), static_cast<Eigen::Index>(values.size())));
  };
  std::vector<Eigen::VectorXf> kinds;
  for (const Mesh& mesh : {test::box(1, 2, 3), test::cylinder(24, 1, 0, 2), test::icosphere(2)}) {
    kinds.push_back(vector_of(mesh));
    EXPECT_NEAR(kinds.back().norm(), 1.0F, 1e-5F);
    for (const Eigen::Quaterniond& q : {Eigen::Quaterniond(1, 2, 3, 4), Eigen::Quaterniond(-1, 0.5, 0.1, 2)}) {
      const float moved = (vector_of(test::turned(mesh, q.normalized())) - kinds.back()).norm();
      EXPECT_LT(moved, 0.25F);
    }
  }
  for (std::size_t a = 0; a < kinds.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      EXPECT_GT((kinds[a] - kinds[b]).norm(), 0.5F) << a << ", " << b;
    }
  }
}

TEST(PrepareObject, GivesTheBinSizeInTheUnitOfPreparedPoints) {
  const PointCloud cloud{{{0, 0, 0}, {10, 0, 0}, {20, 0, 0}, {30, 0, 0}, {40, 0, 0}}, {}, {}};
  Settings settings;
  settings.spin.bin_size = 3.0;
  const auto bin_size_in = [&](BinSizeUnit unit) {
    settings.bin_size_unit = unit;
    const Preparation preparation = prepare_object(cloud, settings);
    EXPECT_DOUBLE_EQ(preparation.object.scale, 1.0 / 20.0);
    return preparation.params.bin_size;
  };
  EXPECT_DOUBLE_EQ(bin_size_in(BinSizeUnit::relative), 3.0);
  EXPECT_DOUBLE_EQ(bin_size_in(BinSizeUnit::absolute), 0.15);
  EXPECT_DOUBLE_EQ(bin_size_in(BinSizeUnit::resolution), 1.5);
}

class Preset : public testing::TestWithParam<const char*> {};

TEST_P(Preset, TrainsTheSameBytesOnAnyNumberOfThreads) {
  const TrainResult one = train(shapes(), small_settings(GetParam()));
  const TrainResult three = train(shapes(), small_settings(GetParam()), {.threads = 3});
  EXPECT_EQ(model_bytes(one.model), model_bytes(three.model));
  EXPECT_TRUE(one.skipped.empty());
  EXPECT_EQ(one.model.categories(), (std::vector<std::string>{"ball", "box", "cone", "spindle"}));
  EXPECT_EQ(one.model.object_counts(), std::vector<std::uint32_t>(4, kShapesEach));
  EXPECT_EQ(one.model.judge_count(), 6U);
}

TEST_P(Preset, EvaluatesTheSameOnAnyNumberOfThreads) {
  const Evaluation one = evaluated(small_settings(GetParam()), 1);
  const Evaluation three = evaluated(small_settings(GetParam()), 3);
  EXPECT_EQ(one.confusion, three.confusion);
  EXPECT_EQ(one.mean_class_rate.mean, three.mean_class_rate.mean);
  EXPECT_EQ(one.mean_class_rate.deviation, three.mean_class_rate.deviation);
  EXPECT_EQ(one.overall_rate.mean, three.overall_rate.mean);
  ASSERT_EQ(one.confusion.size(), 4U);
  for (const auto& row : one.confusion) {
    ASSERT_EQ(row.size(), 4U);
    EXPECT_EQ(row[0] + row[1] + row[2] + row[3], 3U);  // one of six in each of three splits
  }
}

INSTANTIATE_TEST_SUITE_P(Presets, Preset, testing::Values("default", "paper"));

// So many copies that a few of the objects are sample enough for the directions of all.
Settings settings_of_many_rows() {
  Settings settings = small_settings();
  settings.prepare.points = 100;
  settings.prepare.surface = SurfaceKind::samples;
  settings.radial = settings.plain_samples = false;
  settings.prepare.spin_points = 16;
  settings.copies = 78;
  return settings;
}

TEST(DescribeDataset, KeepsCoordinatesWhereRowsAreMany) {
  const Settings settings = settings_of_many_rows();
  const auto rows_each = static_cast<std::size_t>(settings.training_rows());
  ASSERT_GT(shapes().objects.size() * rows_each, kMostSampleRows + 5 * rows_each);
  BroadcastRows broadcast;
  const FeatureTable whole = describe_dataset(shapes(), settings, {.threads = 2}, 0, kNeverAlongBasis, broadcast);
  const FeatureTable table = describe_dataset(shapes(), settings, {.threads = 2}, 0, kMostSampleRows, broadcast);
  ASSERT_EQ(table.features.rows(), whole.features.rows());
  ASSERT_EQ(table.background_rows, 12U);
  EXPECT_EQ(table.basis.cols(), whole.features.cols());
  EXPECT_EQ(table.basis.rows(), table.features.cols());
  EXPECT_LT(table.features.cols(), whole.features.cols());
  const FeatureMatrix expected = whole.features * table.basis.transpose();
  EXPECT_LT((table.features - expected).cwiseAbs().maxCoeff(), 1e-3F);
  // What the coordinates leave out is little.
  const FeatureMatrix centred = whole.features.rowwise() - whole.features.colwise().mean();
  const FeatureMatrix kept = table.features.rowwise() - table.features.colwise().mean();
  EXPECT_GT(kept.squaredNorm(), 0.95F * centred.squaredNorm());
}

TEST(DescribeDataset, PutsOthersAndShapesBelowTheObjects) {
  const TempDir dir;
  Dataset dataset = shapes();
  dataset.others = {dir.write("a.off", test::off_text(test::box(1, 9, 1))), dir / "absent.off",
                    dir.write("b.off", test::off_text(test::box(9, 9, 1)))};
  const Settings settings = small_settings();
  const FeatureTable table = describe_dataset(dataset, settings, {.threads = 2});
  EXPECT_EQ(table.background_rows, 12U + 2U);
  EXPECT_EQ(table.other_rows, 2U);
  ASSERT_EQ(table.skipped.size(), 1U);
  EXPECT_EQ(table.skipped[0].file, dir / "absent.off");
  EXPECT_EQ(table.features.rows(), static_cast<Eigen::Index>(table.objects.size() * table.rows_per_object + 14));
  const std::vector<float> first = describe(test::box(1, 9, 1), settings).values;
  const auto row = table.features.row(table.rows_of_background().front());
  EXPECT_TRUE(std::ranges::equal(first, std::vector<float>(row.begin(), row.end())));
  EXPECT_NE(input_error([&] { describe_dataset(dataset, settings, {.threads = 2, .strict = true}); }).find("absent"),
            std::string::npos);
}

// Three long boxes across each other.
Mesh star(double length) {
  return test::joined(test::joined(test::box(1, length, 1), test::box(length, 1, 1)), test::box(1, 1, length));
}

TEST(Train, KnowsStrangersByTheUsersOthers) {
  const TempDir dir;
  Dataset dataset = shapes();
  for (int k = 0; k < 8; ++k) {
    dataset.others.push_back(dir.write(fmt::format("{}.off", k), test::off_text(star(6.0 + 0.5 * k))));
  }
  const Model model = train(dataset, small_settings(), {.threads = 2}).model;
  EXPECT_TRUE(model.tells_strangers());
  const double stranger = classify(model, star(7.25)).known;
  for (std::uint32_t c = 0; c < 4; ++c) {
    EXPECT_GT(classify(model, shape_of(model.categories()[c], kShapesEach)).known, stranger) << model.categories()[c];
  }
  EXPECT_LT(stranger, model.least_known());
}

TEST(Train, LearnsFromCoordinatesTheSameOnAnyNumberOfThreads) {
  const Settings settings = settings_of_many_rows();
  const Model model = train(shapes(), settings, {.threads = 1}).model;
  EXPECT_EQ(model_bytes(train(shapes(), settings, {.threads = 3}).model), model_bytes(model));
  int right = 0;
  const TempDir dir;
  for (std::uint32_t c = 0; c < 4; ++c) {
    const auto file = dir.write("held-out.off", test::off_text(shape_of(model.categories()[c], kShapesEach + 1)));
    right += classify_file(model, file).ballot.winner == c ? 1 : 0;
  }
  EXPECT_EQ(right, 4);
}

TEST(Train, NamesHeldOutShapes) {
  const Model model = train(shapes(), small_settings(), {}).model;
  const TempDir dir;
  for (std::uint32_t c = 0; c < 4; ++c) {
    for (int k = kShapesEach; k < kShapesEach + 3; ++k) {
      const auto file = dir.write("held-out.off", test::off_text(shape_of(model.categories()[c], k)));
      const Classification found = classify_file(model, file);
      EXPECT_EQ(found.ballot.winner, c) << model.categories()[c] << k;
      EXPECT_EQ(found.ballot.count[c], 3U);
      EXPECT_GT(found.confidence, 0.5);
      EXPECT_LT(found.confidence, 1.0);
      EXPECT_EQ(found.confidence, classify(model, read_object(file)).confidence);
    }
  }
}

TEST(Train, AModelFileNamesAsItsModelDoes) {
  const Model model = train(shapes(), small_settings(), {}).model;
  const TempDir dir;
  write_model(dir / "m.spincat", model);
  const Model read = read_model(dir / "m.spincat");
  const Object object = shape_of("cone", 77);
  const Ballot a = classify(model, object).ballot;
  const Ballot b = classify(read, object).ballot;
  EXPECT_EQ(a.margin_sum, b.margin_sum);
  EXPECT_EQ(a.winner, b.winner);
}

TEST(Train, SkipsAndListsWhatCannotBeRead) {
  Dataset dataset = shapes();
  const TempDir dir;
  dataset.objects.push_back({dir.write("bad.off", "OFF 3 1 0\n0 0 zero\n"), 1, ""});
  dataset.objects.push_back({dir / "none.off", 0, ""});
  dataset.objects.push_back({dir.write("point.off", "OFF 2 0 0\n1 1 1\n1 1 1\n"), 2, ""});
  for (const int threads : {1, 3}) {
    const TrainResult result = train(dataset, small_settings(), {.threads = threads});
    ASSERT_EQ(result.skipped.size(), 3U);
    EXPECT_EQ(result.skipped[0].file, dir / "bad.off");
    EXPECT_EQ(result.skipped[1].file, dir / "none.off");
    EXPECT_EQ(result.skipped[2].file, dir / "point.off");
    EXPECT_EQ(result.skipped[2].reason, "all its points are at one place");
    EXPECT_EQ(model_bytes(result.model), model_bytes(train(shapes(), small_settings(), {}).model));
  }
}

TEST(Train, StrictThrowsTheFirstThatCannotBeRead) {
  Dataset dataset = shapes();
  const TempDir dir;
  dataset.objects.insert(dataset.objects.begin() + 3, {dir.write("point.off", "OFF 2 0 0\n1 1 1\n1 1 1\n"), 2, ""});
  dataset.objects.insert(dataset.objects.begin() + 4, {dir / "none.off", 2, ""});
  for (const int threads : {1, 4}) {
    EXPECT_EQ(input_error([&] { train(dataset, small_settings(), {.threads = threads, .strict = true}); }),
              (dir / "point.off").string() + ": all its points are at one place");
  }
}

TEST(Train, RefusesACategoryWithoutAnObjectThatCanBeRead) {
  Dataset dataset = shapes();
  dataset.categories.push_back("tetrapod");
  EXPECT_EQ(input_error([&] { train(dataset, small_settings(), {}); }),
            dataset.name + ": no object of category 'tetrapod' could be read");
  const TempDir dir;
  dataset.objects.push_back({dir / "none.off", 4, ""});
  const std::string error = input_error([&] { train(dataset, small_settings(), {}); });
  EXPECT_NE(error.find("no object of category 'tetrapod' could be read (1 could not; the first, "), std::string::npos);
  EXPECT_NE(error.find("none.off"), std::string::npos);
}

TEST(Train, RefusesFewerThanTwoCategories) {
  Dataset one = shapes();
  one.categories.resize(1);
  std::erase_if(one.objects, [](const DatasetObject& object) { return object.category != 0; });
  EXPECT_EQ(input_error([&] { train(one, small_settings(), {}); }),
            one.name + ": two or more categories are needed to learn from");
  EXPECT_NE(input_error([&] { train({}, small_settings(), {}); }), "no error");
}

TEST(Train, LeavesOutObjectsWithFewerConcatenatedImages) {
  Settings settings = small_settings("paper");
  settings.prepare.surface = SurfaceKind::samples;  // repeats no points
  Dataset dataset = shapes();
  const TempDir dir;
  const auto small = dir.write("small.xyz.off", "OFF 4 0 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n");
  for (const std::ptrdiff_t at : {0, 10, 26}) {
    dataset.objects.insert(dataset.objects.begin() + at, {small, 1, ""});
  }
  const TrainResult result = train(dataset, settings, {});
  ASSERT_EQ(result.skipped.size(), 3U);
  EXPECT_EQ(result.skipped[0].reason, "gives 256 features where others give 3072");
  EXPECT_EQ(result.model.feature_length(), 3072U);
  EXPECT_EQ(input_error([&] { train(dataset, settings, {.threads = 1, .strict = true}); }),
            small.string() + ": gives 256 features where others give 3072");
  EXPECT_EQ(input_error([&] { classify_file(result.model, small); }),
            small.string() + ": gives 256 features where the model expects 3072");
}

TEST(Train, RefusesSettingsBeforeAnyWork) {
  Settings settings = small_settings();
  settings.copies = -1;
  bool started = false;
  EXPECT_EQ(input_error([&] {
              train(shapes(), settings,
                    {.progress = [&](std::string_view, std::size_t, std::size_t) { started = true; }});
            }),
            "copies -1: expected 0 to 100");
  EXPECT_FALSE(started);
}

TEST(Progress, NeverFallsAndReachesTheTotalNeverTwoAtATime) {
  std::map<std::string, std::pair<std::size_t, std::size_t>> stages;
  std::mutex mutex;
  const Progress progress = [&](std::string_view stage, std::size_t done, std::size_t total) {
    ASSERT_TRUE(mutex.try_lock());
    auto& [last, all] = stages[std::string(stage)];
    EXPECT_GE(done, last) << stage;
    EXPECT_LE(done, total);
    last = done;
    all = total;
    mutex.unlock();
  };
  train(shapes(), small_settings("paper"), {.threads = 3, .progress = progress});
  EvaluateOptions options;
  options.splits = 2;
  evaluate(shapes(), small_settings("paper"), options,
           {.progress = [&](std::string_view stage, std::size_t done, std::size_t total) {
             if (stage == "judging splits") {
               progress(stage, done, total);
             }
           }});
  EXPECT_EQ(stages.size(), 4U);
  for (const auto& [stage, counts] : stages) {
    EXPECT_EQ(counts.first, counts.second) << stage;
  }
}

TEST(Progress, AnExceptionEndsTheWorkInAnyStage) {
  struct Interrupted {};
  for (const std::string stage : {"describing objects", "comparing objects", "training judges"}) {
    for (const int threads : {1, 3}) {
      const Progress progress = [&](std::string_view now, std::size_t, std::size_t) {
        if (now == stage) {
          throw Interrupted();
        }
      };
      EXPECT_THROW(train(shapes(), small_settings("paper"), {.threads = threads, .progress = progress}), Interrupted)
          << stage;
    }
  }
}

TEST(Describe, PartsAreJoinedAtLengthOne) {
  Settings settings = small_settings();
  settings.plain_samples = false;
  const Object object = test::box(1, 2, 3);
  const FeatureVector one = describe(object, settings);
  settings.plain_samples = true;
  settings.up = UpAxis::z;
  const FeatureVector three = describe(object, settings);
  ASSERT_EQ(three.values.size(), 3 * one.values.size());
  EXPECT_EQ(three.blocks.size(), 3 * one.blocks.size());
  double squared = 0.0;
  for (std::size_t i = 0; i < three.values.size(); ++i) {
    squared += static_cast<double>(three.values[i]) * static_cast<double>(three.values[i]);
    if (i < one.values.size()) {
      EXPECT_FLOAT_EQ(three.values[i], one.values[i] / std::sqrt(3.0F));
    }
  }
  EXPECT_NEAR(squared, 1.0, 1e-5);
}

TEST(Describe, TheUpAxisPartTellsHowAnObjectStands) {
  // A box lying and standing: the same to all parts but that of the up axis, which sees no difference between boxes
  // that are turned about it.
  Settings settings = preset("default");
  settings.plain_samples = false;
  settings.up = UpAxis::z;
  const auto last_part = [&](const Mesh& mesh) {
    const std::vector<float> values = describe(mesh, settings).values;
    const auto half = static_cast<Eigen::Index>(values.size() / 2);
    return Eigen::VectorXf(Eigen::Map<const Eigen::VectorXf>(values.data() + half, half));
  };
  const Eigen::VectorXf standing = last_part(test::box(1, 1, 3));
  const double turn = 0.7;
  const Mesh turned = test::turned(test::box(1, 1, 3), Eigen::Quaterniond(Eigen::AngleAxisd(turn, Vec3(0, 0, 1))));
  EXPECT_LT((last_part(turned) - standing).norm(), 0.15F);
  EXPECT_GT((last_part(test::box(3, 1, 1)) - standing).norm(), 0.4F);
}

TEST(Describe, DrawsAreAveraged) {
  Settings settings = small_settings();
  const Object object = test::box(1, 2, 3);
  const auto vector_of = [&](int draws, std::uint64_t seed) {
    settings.draws = draws;
    settings.seed = seed;
    const std::vector<float> values = describe(object, settings).values;
    return Eigen::VectorXf(Eigen::Map<const Eigen::VectorXf>(values.data(), static_cast<Eigen::Index>(values.size())));
  };
  // The mean over nine draws moves about a third as much from seed to seed as a single one.
  const float single = (vector_of(1, 1) - vector_of(1, 2)).norm();
  const float mean = (vector_of(9, 1) - vector_of(9, 2)).norm();
  EXPECT_GT(mean, 0.0F);
  EXPECT_LT(mean, 0.6F * single);
}

TEST(Describe, CloudCopiesAreClouds) {
  Settings settings = small_settings();
  EXPECT_EQ(settings.training_rows(), 5);
  settings.trained_for = TrainedFor::meshes;
  EXPECT_EQ(settings.training_rows(), 2);
  settings.copies = 2;
  settings.trained_for = TrainedFor::any;
  EXPECT_EQ(settings.training_rows(), 6);
  // As many points as asked for, and not those that can be seen of a mesh: all of them may be drawn from a hidden face.
  const Object object = test::box();
  for (int copy = 1; copy < 6; ++copy) {
    const PreparedObject prepared = test::prepare_copy(object, settings, copy).object;
    double off_surface = 0.0;
    for (std::size_t i = 0; i < prepared.surface.size(); ++i) {
      const Eigen::Vector3f n = prepared.surface.normal(i);
      off_surface = std::max(off_surface, 1.0 - static_cast<double>(n.cwiseAbs().maxCoeff()));
    }
    // The normals of a box's faces are axes; estimated ones near its edges are not.
    EXPECT_EQ(off_surface > 1e-3, copy > 2) << copy;
  }
}

TEST(TrainForAny, NamesCloudsAsWell) {
  Settings settings = small_settings();
  settings.copies = 2;
  settings.trained_for = TrainedFor::any;
  const Model model = train(shapes(), settings, {.threads = 2}).model;
  int right = 0;
  for (const DatasetObject& object : shapes().objects) {
    const Object cloud = as_cloud(read_object(object.file), 400, 0.005, 77);
    right += classify(model, cloud).ballot.winner == object.category ? 1 : 0;
  }
  EXPECT_GE(right, 20);  // of 24
}

TEST(TrainJudges, TestObjectsDoNotInfluenceTheCodebook) {
  Settings settings = small_settings();
  settings.encoding = "bag-of-features";
  settings.judge.dimensions = 0;
  settings.background = 0;
  settings.words = 8;
  FeatureTable table = describe_dataset(shapes(), settings, {.threads = 2, .strict = true});
  std::vector<std::uint32_t> learned;
  for (std::uint32_t object = 0; object < table.objects.size(); ++object) {
    if (object % 3 != 0) {
      learned.push_back(object);
    }
  }
  const auto trained = [&] {
    LocalFarm farm(2);
    return JudgeTrainer(BroadcastTable(table, farm.farm()), settings.judge).train(learned);
  };
  const JudgeList before = trained();
  EXPECT_EQ(before.codebook.words.rows(), 8);
  const std::vector<std::uint32_t> tested = {0, 3, 6, 9, 12, 15, 18, 21};
  for (const std::uint32_t row : table.rows_of(tested)) {
    table.features.row(row).setConstant(7.0F);
  }
  const JudgeList after = trained();
  EXPECT_TRUE(after.codebook.words == before.codebook.words);
  EXPECT_TRUE(after.weights == before.weights);
  for (const std::uint32_t row : table.rows_of(std::vector<std::uint32_t>{1})) {
    table.features.row(row).setConstant(7.0F);
  }
  EXPECT_FALSE(trained().codebook.words == before.codebook.words);  // a training object does
}

class Variant : public testing::TestWithParam<std::pair<const char*, KernelKind>> {};

TEST_P(Variant, FindsEasyShapesAndKeepsItsModel) {
  Settings settings = small_settings();
  settings.encoding = GetParam().first;
  settings.words = 16;
  settings.judge.kernel = GetParam().second;
  settings.judge.dimensions = 0;
  settings.judge.c = default_c(settings.judge);
  EXPECT_GE(evaluated(settings, 2).mean_class_rate.mean, 0.6);
  const Model model = train(shapes(), settings, {.threads = 1}).model;
  EXPECT_EQ(model_bytes(train(shapes(), settings, {.threads = 3}).model), model_bytes(model));
  const TempDir dir;
  write_model(dir / "m.spincat", model);
  const Model back = read_model(dir / "m.spincat");
  int right = 0;
  for (const DatasetObject& object : shapes().objects) {
    const Classification found = classify_file(back, object.file);
    EXPECT_EQ(found.ballot.weakest_margin, classify_file(model, object.file).ballot.weakest_margin);
    right += found.ballot.winner == object.category ? 1 : 0;
  }
  EXPECT_GE(right, 22);  // of 24
}

INSTANTIATE_TEST_SUITE_P(All, Variant,
                         testing::Values(std::pair("pooled-pyramid", KernelKind::rbf),
                                         std::pair("mean-image", KernelKind::linear),
                                         std::pair("bag-of-features", KernelKind::linear),
                                         std::pair("bag-of-features", KernelKind::rbf)));

TEST(Evaluate, FindsEasyShapes) {
  const Evaluation found = evaluated(small_settings(), 2);
  EXPECT_EQ(found.splits, 3);
  EXPECT_EQ(found.object_counts, std::vector<std::uint32_t>(4, kShapesEach));
  EXPECT_GE(found.mean_class_rate.mean, 0.9);
  EXPECT_EQ(found.dataset, shapes_folder().string());
}

TEST(Evaluate, RatesAreThoseOfTheConfusionMatrix) {
  // Every category tests one object a split, so that both rates are the share of the diagonal.
  const Evaluation found = evaluated(small_settings("paper"), 1);
  double right = 0.0;
  for (std::size_t c = 0; c < 4; ++c) {
    right += found.confusion[c][c];
  }
  EXPECT_NEAR(found.mean_class_rate.mean, right / 12.0, 1e-12);
  EXPECT_NEAR(found.overall_rate.mean, right / 12.0, 1e-12);
}

TEST(Evaluate, ACategoryWithOneObjectIsNeverTested) {
  Dataset dataset = shapes();
  bool kept = false;
  std::erase_if(dataset.objects,
                [&](const DatasetObject& object) { return object.category == 2 && std::exchange(kept, true); });
  EvaluateOptions options;
  options.splits = 2;
  const Evaluation found = evaluate(dataset, small_settings("paper"), options);
  EXPECT_EQ(found.object_counts, (std::vector<std::uint32_t>{6, 6, 1, 6}));
  EXPECT_EQ(found.confusion[2], std::vector<std::uint32_t>(4, 0));
  double right = 0.0;
  for (const std::size_t c : {0, 1, 3}) {
    right += found.confusion[c][c];
  }
  EXPECT_NEAR(found.mean_class_rate.mean, right / 6.0, 1e-12);  // over the three categories that are tested
}

TEST(Evaluate, OptionsOutOfRangeAreRefused) {
  EvaluateOptions options;
  options.splits = 0;
  EXPECT_EQ(input_error([&] { evaluate(shapes(), small_settings(), options); }),
            "number of splits 0 is out of range (1 to 10000)");
  options.splits = 2;
  for (const double share : {0.0, 1.0, -0.5, std::nan("")}) {
    options.test_share = share;
    bool started = false;
    EXPECT_NE(input_error([&] {
                evaluate(shapes(), small_settings(), options,
                         {.progress = [&](std::string_view, std::size_t, std::size_t) { started = true; }});
              }).find("test share"),
              std::string::npos);
    EXPECT_FALSE(started) << "hours of work before the refusal";
  }
}

TEST(Classify, AnObjectThatDoesNotFitIsRefusedWithItsFile) {
  ModelData model = train(shapes(), small_settings()).model.data();
  const TempDir dir;
  const auto same = dir.write("same.off", "OFF 2 0 0\n1 1 1\n1 1 1\n");
  EXPECT_EQ(input_error([&] { classify_file(model, same); }), same.string() + ": all its points are at one place");
  const auto length = static_cast<std::size_t>(model.judges.weights.cols());
  model.judges.whitening.columns = HalfRows(7, std::vector<std::uint16_t>(7 * length));
  EXPECT_EQ(input_error([&] { classify(model, test::box()); }), "gives 192 features where the model expects 7");
}

}  // namespace
}  // namespace spincat
