#include "spincat/train/train.h"

#include <numeric>
#include <utility>

#include "spincat/classify/model_data.h"
#include "spincat/describe/stopwatch.h"
#include "spincat/parallel/farm_execution.h"
#include "spincat/train/broadcast_table.h"
#include "spincat/train/describe_dataset.h"
#include "spincat/train/judge_trainer.h"
#include "spincat/train/learned_space.h"
#include "spincat/train/worth_broadcasting.h"
#include "spincat/version.h"

namespace spincat {

TrainResult train(const Dataset& dataset, const Settings& settings, const Execution& execution) {
  // Describe every object and its stretched copies once.
  const FarmExecution run(execution);
  const std::size_t trainings = count_trainings(1, true);
  BroadcastRows rows;
  const FeatureTable table = describe_dataset(dataset, settings, run, trainings, kMostSampleRows, rows);
  std::vector<std::uint32_t> objects(table.objects.size());
  std::iota(objects.begin(), objects.end(), 0U);

  // Train a judge for every pair of categories, and find out how far their votes can be trusted.
  Stopwatch watch;
  const BroadcastTable broadcast(table, *run.farm, rows, trainings);
  JudgeTrainer trainer(broadcast, settings.judge, run.progress);
  ModelData model;
  CalibratedJudges trained = trainer.train_calibrated(objects, settings.seed, run.progress);
  model.judges = std::move(trained.judges);
  model.calibration = trained.calibration;
  model.known = std::move(trained.known);

  // Keep what classifying needs to repeat all of this.
  model.settings = settings;
  model.categories = table.categories;
  model.kinds = table.kinds;
  model.dataset = dataset.name;
  model.made_by = kProgram;
  model.object_counts = table.object_counts();
  StageSeconds seconds = table.seconds;
  seconds.judge += watch.lap();
  return {Model(std::move(model)), table.skipped, seconds};
}

}  // namespace spincat
