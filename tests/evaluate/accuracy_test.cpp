// Guards against a fall of the rates that docs/how-it-works/encoding.md is about: on generated furniture always, on the
// Princeton Shape Benchmark's where SPINCAT_PSB names a folder that has it.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <numeric>
#include <string>
#include <vector>

#include "spincat/dataset/splits.h"
#include "spincat/evaluate/evaluate.h"
#include "spincat/geometry/random.h"
#include "spincat/io/read_object.h"
#include "spincat/parallel/task_farm.h"
#include "spincat/prepare/as_cloud.h"
#include "spincat/train/broadcast_table.h"
#include "spincat/train/describe_dataset.h"
#include "spincat/train/judge_trainer.h"
#include "support/shapes.h"
#include "support/temp_dir.h"

namespace spincat {
namespace {

constexpr int kEach = 10;  // objects of every kind

// Adds a box with the given corner and edges.
void add_box(Mesh& mesh, const Vec3& corner, const Vec3& edges) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  const Mesh box = test::box(edges.x(), edges.y(), edges.z());
  for (const Vec3& v : box.vertices) {
    mesh.vertices.emplace_back(v + corner + 0.5 * edges);
  }
  for (const Triangle& t : box.triangles) {
    mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
}

void add_legs(Mesh& mesh, double wide, double deep, double high, double thick) {
  for (const double x : {0.0, wide - thick}) {
    for (const double y : {0.0, deep - thick}) {
      add_box(mesh, Vec3(x, y, 0), Vec3(thick, thick, high));
    }
  }
}

// A piece of furniture made of boxes, in proportions of its own.
Mesh furniture(const std::string& kind, int k) {
  Random random(derive_seed(static_cast<std::uint64_t>(kind[0]) * 256 + static_cast<std::uint64_t>(kind[1]),
                            static_cast<std::uint64_t>(k)));
  Mesh mesh;
  const double w = random.uniform(0.6, 1.4);
  const double d = random.uniform(0.6, 1.1);
  const double h = random.uniform(0.5, 1.3);
  const double t = random.uniform(0.04, 0.1);
  if (kind == "table") {
    add_legs(mesh, w, d, h, t);
    add_box(mesh, Vec3(0, 0, h), Vec3(w, d, t));
  } else if (kind == "chair") {
    add_legs(mesh, 0.6 * w, 0.6 * d, 0.6 * h, t);
    add_box(mesh, Vec3(0, 0, 0.6 * h), Vec3(0.6 * w, 0.6 * d, t));
    add_box(mesh, Vec3(0, 0.6 * d - t, 0.6 * h), Vec3(0.6 * w, t, random.uniform(0.5, 0.9)));
  } else if (kind == "shelf") {
    add_box(mesh, Vec3(0, 0, 0), Vec3(t, 0.4 * d, 1.5 * h));
    add_box(mesh, Vec3(w, 0, 0), Vec3(t, 0.4 * d, 1.5 * h));
    const auto boards = static_cast<int>(3 + random.below(4));
    for (int i = 0; i < boards; ++i) {
      add_box(mesh, Vec3(0, 0, 1.5 * h * i / (boards - 1)), Vec3(w + t, 0.4 * d, t));
    }
  } else if (kind == "couch") {
    add_box(mesh, Vec3(0, 0, 0), Vec3(1.6 * w, 0.7 * d, 0.35));
    add_box(mesh, Vec3(0, 0.7 * d, 0), Vec3(1.6 * w, 0.2, random.uniform(0.6, 0.9)));
    add_box(mesh, Vec3(-0.2, 0, 0), Vec3(0.2, 0.7 * d + 0.2, 0.55));
    add_box(mesh, Vec3(1.6 * w, 0, 0), Vec3(0.2, 0.7 * d + 0.2, 0.55));
  } else {  // cabinet
    add_box(mesh, Vec3(0, 0, 0), Vec3(w, 0.5 * d, 1.2 * h));
  }
  const Eigen::Quaterniond turn(random.normal(), random.normal(), random.normal(), random.normal());
  return test::turned(mesh, turn.normalized());
}

const std::filesystem::path& furniture_folder() {
  static const test::TempDir dir;
  static const bool written = [] {
    for (const char* kind : {"cabinet", "chair", "couch", "shelf", "table"}) {
      for (int k = 0; k < kEach; ++k) {
        dir.write(fmt::format("{0}/{0}{1}.off", kind, k), test::off_text(furniture(kind, k)));
      }
    }
    return true;
  }();
  static_cast<void>(written);
  return dir.path();
}

Settings fewer_copies(int copies) {
  Settings settings = preset("default");
  settings.copies = copies;
  return settings;
}

double rate(const Dataset& dataset, const Settings& settings) {
  EvaluateOptions options;
  options.splits = 5;
  return evaluate(dataset, settings, options, {.threads = 2}).mean_class_rate.mean;
}

// The share of objects that are named right by judges trained on half of the objects, shown to them as noisy clouds.
double cloud_rate(const Dataset& dataset, const Settings& settings) {
  const FeatureTable table = describe_dataset(dataset, settings, {.threads = 2, .strict = true});
  const std::vector<std::uint32_t> labels = table.object_labels();
  const Split split = stratified_splits(labels, 1, 0.5, 1)[0];
  LocalFarm farm(2);
  const JudgeList judges = JudgeTrainer(BroadcastTable(table, farm.farm()), settings.judge).train(split.train);
  double right = 0.0;
  for (const std::uint32_t i : split.test) {
    const Object cloud = as_cloud(read_object(dataset.objects[i].file), 2048, 0.01, derive_seed(9, i));
    right += judges.vote(describe(cloud, settings).values).winner == labels[i] ? 1.0 : 0.0;
  }
  return right / static_cast<double>(split.test.size());
}

TEST(Accuracy, GeneratedFurnitureStaysKnown) {
  EXPECT_GE(rate(read_dataset({furniture_folder()}), fewer_copies(1)), 0.95);
}

TEST(Accuracy, GeneratedFurnitureStaysKnownAsClouds) {
  Settings settings = fewer_copies(2);
  settings.trained_for = TrainedFor::any;
  EXPECT_GE(cloud_rate(read_dataset({furniture_folder()}), settings), 0.9);
}

TEST(Accuracy, PrincetonFurnitureStaysKnown) {
  const char* const folder = std::getenv("SPINCAT_PSB");
  if (folder == nullptr) {
    GTEST_SKIP() << "SPINCAT_PSB does not name a folder with the Princeton Shape Benchmark's furniture";
  }
  DatasetOptions options;
  options.category_map = std::filesystem::path(SPINCAT_SOURCE_DIR) / "data/psb-furniture.csv";
  EXPECT_GE(rate(read_dataset({folder}, options), fewer_copies(2)), 0.90);
}

}  // namespace
}  // namespace spincat
