// Training on ranks (threads that play them) gives what one thread gives.
#include "spincat/train/judge_trainer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <mutex>
#include <numeric>
#include <thread>
#include <tuple>
#include <vector>

#include "parallel/thread_ranks.h"
#include "spincat/error.h"
#include "spincat/evaluate/evaluation_data.h"
#include "spincat/evaluate/tested_objects.h"
#include "spincat/evaluate/trial.h"
#include "spincat/geometry/random.h"
#include "spincat/parallel/task_server.h"
#include "spincat/rank_work.h"
#include "spincat/train/broadcast_table.h"
#include "spincat/train/describe_dataset.h"
#include "spincat/train/feature_table.h"
#include "spincat/train/train_tasks.h"
#include "support/temp_dir.h"
#include "support/tiny_dataset.h"

namespace spincat {
namespace {

constexpr std::size_t kWorthBroadcasting = 1'000'000'000;  // so much work that a tiny table is sent

// 30 objects of three categories, each with a copy; 24 features in blocks of 8, or as three local features.
FeatureTable noisy_table(bool local, std::uint32_t background_rows = 0) {
  FeatureTable table;
  table.categories = {"a", "b", "c"};
  table.rows_per_object = 2;
  table.blocks = {8, 8, 8};
  table.local_size = local ? 8 : 0;
  table.words = 4;
  table.background_rows = background_rows;
  table.features.resize(60 + background_rows, 24);
  Random random(5);
  for (std::uint32_t i = 0; i < 30; ++i) {
    table.objects.push_back({"object", i % 3, ""});
    for (Eigen::Index row = 2 * i; row < 2 * i + 2; ++row) {
      for (Eigen::Index d = 0; d < 24; ++d) {
        table.features(row, d) = static_cast<float>(0.5 * random.normal() + (d % 8 == i % 3 ? 1.0 : 0.0));
      }
    }
  }
  for (float& value : table.features.bottomRows(background_rows).reshaped()) {
    value = static_cast<float>(random.normal() - 0.5);
  }
  return table;
}

std::vector<std::uint32_t> all_objects() {
  std::vector<std::uint32_t> objects(30);
  std::iota(objects.begin(), objects.end(), 0U);
  return objects;
}

CalibratedJudges train_on(TaskFarm& farm, const FeatureTable& table, const JudgeSettings& settings) {
  const BroadcastTable broadcast(table, farm, {}, kWorthBroadcasting);
  EXPECT_TRUE(broadcast.is_broadcast());
  JudgeTrainer trainer(broadcast, settings);
  return trainer.train_calibrated(all_objects(), 7);
}

std::string packed(const Context& context) {
  Packer packer;
  context(packer);
  return packer.take();
}

constexpr std::uint64_t kBroadcastId = 7;

std::string table_context(const FeatureTable& table, const BroadcastRows& rows = {}) {
  return packed([&](Packer& packer) { pack_table(table, kBroadcastId, rows, packer); });
}

std::string gram_context(std::uint64_t broadcast_id = kBroadcastId) {
  return packed([=](Packer& packer) { pack_gram_context({broadcast_id, 0}, KernelKind::linear, packer); });
}

// Ranks that serve as the command's do.
class ServingRanks {
 public:
  explicit ServingRanks(int count) : wires_(std::make_shared<test::Wires>(count)), own_(wires_, 0) {
    for (int r = 1; r < count; ++r) {
      servers_.emplace_back([this, wires = wires_, r] {
        test::ThreadCommunicator ranks(wires, r);
        serve(ranks, noting_what_it_makes(), {[](int) { return 2; }, [] {}});
      });
    }
  }
  ~ServingRanks() { join(); }
  Communicator& communicator() { return own_; }

  // How often any rank has begun work of this kind. Wait for the end of the farm first.
  int begun(const std::string& kind) {
    join();
    return begun_[kind];
  }

 private:
  void join() {
    for (std::thread& server : servers_) {
      if (server.joinable()) {
        server.join();
      }
    }
  }

  WorkFactory noting_what_it_makes() {
    return [this, make = rank_work()](std::string_view kind, std::string_view context) {
      RankWork work = make(kind, context);
      const std::lock_guard lock(begun_mutex_);
      ++begun_[std::string(kind)];
      return work;
    };
  }

  std::shared_ptr<test::Wires> wires_;
  std::mutex begun_mutex_;
  std::map<std::string, int> begun_;
  test::ThreadCommunicator own_;
  std::vector<std::thread> servers_;
};

// A kernel, the dimensions of a small space, and whether features are local.
class Training : public testing::TestWithParam<std::tuple<KernelKind, int, bool>> {};
INSTANTIATE_TEST_SUITE_P(Kernels, Training,
                         testing::Values(std::tuple(KernelKind::linear, 0, false),
                                         std::tuple(KernelKind::linear, 0, true), std::tuple(KernelKind::rbf, 0, false),
                                         std::tuple(KernelKind::rbf, 0, true),
                                         std::tuple(KernelKind::linear, 10, false)));

TEST_P(Training, DoesNotDependOnRanksAndThreads) {
  const auto [kernel, dimensions, local] = GetParam();
  const FeatureTable table = noisy_table(local, dimensions > 0 ? 15 : 0);
  JudgeSettings settings{.kernel = kernel, .dimensions = dimensions};
  settings.c = default_c(settings);
  LocalFarm one(1);
  const BroadcastTable here(table, one.farm(), {}, kWorthBroadcasting);
  JudgeTrainer alone(here, settings);
  const auto [judges, calibration, known] = alone.train_calibrated(all_objects(), 7);
  ASSERT_EQ(judges.size(), 3U);
  EXPECT_NE(calibration.slope, PlattScaling{}.slope);
  EXPECT_EQ(known.empty(), dimensions == 0);
  for (const int count : {2, 4}) {
    ServingRanks ranks(count);
    TaskFarm farm(ranks.communicator());
    farm.use_threads(2, 2);
    const CalibratedJudges trained = train_on(farm, table, settings);
    EXPECT_EQ(trained.judges.weights, judges.weights);
    EXPECT_EQ(trained.judges.support_vectors, judges.support_vectors);
    EXPECT_EQ(trained.judges.bias, judges.bias);
    EXPECT_EQ(trained.judges.supports, judges.supports);
    EXPECT_EQ(trained.calibration.slope, calibration.slope);
    EXPECT_EQ(trained.calibration.offset, calibration.offset);
    EXPECT_EQ(trained.judges.whitening.middle, judges.whitening.middle);
    EXPECT_TRUE(std::ranges::equal(trained.judges.whitening.columns.bits(), judges.whitening.columns.bits()));
    EXPECT_EQ(trained.known.weights, known.weights);
    EXPECT_EQ(trained.known.scaling.slope, known.scaling.slope);
    EXPECT_EQ(trained.known.least, known.least);
  }
}

// Ranks that were told the features as they came need no table, and one that was not takes no part.
TEST(Training, RanksUseTheRowsTheyKept) {
  const FeatureTable table = noisy_table(false);
  BroadcastRows rows{1, {}};
  for (std::uint32_t i = 0; i < 30; ++i) {
    rows.objects.push_back(2 * i + 1);  // every other file could not be read
  }
  RankState kept;
  EXPECT_THROW(make_table_work(table_context(table, rows), kept), RunError);
  EXPECT_THROW(make_gram_work(gram_context(), kept), RunError);
  kept.rows.emplace(60, 2);
  for (std::uint32_t i = 0; i < 30; ++i) {
    std::vector<FeatureBytes> values;
    for (std::uint32_t copy = 0; copy < 2; ++copy) {
      values.emplace_back(table.features_of(i, copy));
    }
    kept.rows->put(rows.objects[i], values);
  }
  make_table_work(table_context(table, rows), kept);
  EXPECT_EQ(kept.table.features, table.features);
  EXPECT_EQ(kept.table.object_labels(), table.object_labels());
  EXPECT_FALSE(kept.rows);
  EXPECT_THROW(make_gram_work(gram_context(kBroadcastId + 1), kept), RunError);  // it has missed another broadcast
  EXPECT_NO_THROW(make_gram_work(gram_context(), kept));
}

// Judges that see the features themselves: other ranks are told these as they come.
Settings settings_without_space() {
  Settings settings = test::tiny_settings();
  settings.judge.dimensions = 0;
  settings.background = 0;
  return settings;
}

// As a sweep over settings of the judges does.
TEST(Training, RanksKeepATableForAnotherTrainer) {
  const test::TempDir dir;
  test::write_tiny_shapes(dir, "shapes", 4);
  constexpr int kRanks = 3;
  ServingRanks ranks(kRanks);
  {
    TaskFarm farm(ranks.communicator());
    BroadcastRows rows;
    const FeatureTable table = describe_dataset(read_dataset({dir / "shapes"}), settings_without_space(),
                                                {.farm = &farm}, kWorthBroadcasting, kNeverAlongBasis, rows);
    ASSERT_EQ(rows.objects.size(), 12U);
    std::vector<std::uint32_t> objects(12);
    std::iota(objects.begin(), objects.end(), 0U);
    for (const double c : {3.0, 300.0}) {
      const JudgeSettings settings{.c = c};
      const BroadcastTable broadcast(table, farm, rows, kWorthBroadcasting);
      JudgeTrainer trainer(broadcast, settings);
      LocalFarm one(1);
      const BroadcastTable here(table, one.farm(), {}, kWorthBroadcasting);
      JudgeTrainer alone(here, settings);
      EXPECT_EQ(trainer.train(objects).weights, alone.train(objects).weights);
    }
  }
  for (const char* kind : {kTableTasks, kGramTasks, kJudgesTasks}) {
    EXPECT_EQ(ranks.begun(kind), 2 * (kRanks - 1)) << kind;
  }
}

TEST(Training, TinyTablesStayHere) {
  const FeatureTable table = noisy_table(false);
  ServingRanks ranks(2);
  TaskFarm farm(ranks.communicator());
  const BroadcastTable here(table, farm);
  EXPECT_FALSE(here.is_broadcast());
  JudgeTrainer trainer(here, JudgeSettings{});
  trainer.train(all_objects());
  EXPECT_EQ(farm.report().seconds, 0.0);
}

TEST(Trials, AreTheSameFromWhatARankKeeps) {
  EvaluationData data;
  data.table = noisy_table(false);
  data.unknown_objects.objects.push_back({"stranger", 0, ""});
  data.unknown_objects.features = FeatureMatrix::Constant(1, 24, 2.0F);
  data.unknown_objects.problems = {""};
  data.tested = TestTable{data.table.objects,           1,  data.table.features(Eigen::seq(1, 59, 2), Eigen::all),
                          std::vector<std::string>(30), {}, {}};
  const Settings settings = settings_without_space();
  LocalFarm one(1);
  const BroadcastTable here(data.table, one.farm());
  JudgeTrainer trainer(here, settings.judge);
  Split split;
  for (std::uint32_t i = 0; i < 30; ++i) {
    (i % 4 == 0 ? split.test : split.train).push_back(i);
  }
  const Trial expected = run_trial(trial_data(data), trainer, split, settings, true);
  EXPECT_EQ(expected.named.size(), split.test.size());
  EXPECT_EQ(expected.unknown_objects.size(), 1U);

  RankState kept;
  make_table_work(table_context(data.table), kept);
  const std::string trials = packed([&](Packer& packer) {
    pack_trials(trial_data(data), {kBroadcastId, 1}, settings, true, packer);
  });
  const RankWork gram = make_gram_work(gram_context(), kept);
  const std::vector<GramTask> strips = gram_tasks(data.table, KernelKind::linear);
  for (std::size_t i = 0; i < strips.size(); ++i) {
    EXPECT_THROW(make_trial_work(trials, kept), RunError) << "without strip " << i;
    gram.keep(i, gram.work(pack(strips[i])));
  }
  EXPECT_EQ(kept.gram.blocks[0], trainer.gram().blocks[0]);
  const Work work = make_trial_work(trials, kept);
  const Trial found = unpack_trial(work(pack(split)));
  EXPECT_EQ(found.confusion, expected.confusion);
  EXPECT_EQ(found.named, expected.named);
  EXPECT_EQ(found.right, expected.right);
  EXPECT_EQ(found.wrong, expected.wrong);
  EXPECT_EQ(found.known, expected.known);
  EXPECT_EQ(found.unknown_objects, expected.unknown_objects);
}

}  // namespace
}  // namespace spincat
