#include "spincat/train/judge_trainer.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "spincat/train/calibration_folds.h"
#include "spincat/train/train_tasks.h"
#include "spincat/train/training.h"

namespace spincat {
namespace {

// The judges of the first training, as they come, in their order. Other ranks are at work before it is made here.
class JudgeCollector {
 public:
  JudgeCollector(Trainings& trainings, std::size_t categories)
      : trainings_(trainings), pairs_(categories * (categories - 1) / 2) {}

  void add(const JudgesTask& task, std::string_view result) {
    if (task.is_of_known_judge()) {
      known_ = unpack_known_judge(result);
      return;
    }
    if (!training().folds()) {
      std::ranges::move(unpack_judges(result), std::back_inserter(judges_));
      return;
    }
    if (!list_) {
      list_ = training().unfilled_list(pairs_);
    }
    put_folded(result, task.first, *list_);
  }

  KnownJudge take_known() { return std::move(known_); }
  JudgeList take() { return list_ ? *std::move(list_) : training().list(judges_); }

 private:
  const Training& training() { return trainings_.training(0); }

  Trainings& trainings_;
  std::size_t pairs_;
  std::optional<JudgeList> list_;  // where the training folds
  std::vector<Judge> judges_;      // where it does not
  KnownJudge known_;
};

TaskFarm::Tick telling(const Progress& progress, const char* stage, std::size_t tasks) {
  return [&progress, stage, tasks](std::size_t done) {
    if (progress) {
      progress(stage, done, tasks);
    }
  };
}

}  // namespace

JudgeTrainer::JudgeTrainer(const BroadcastTable& table, const JudgeSettings& settings, const Progress& progress)
    : where_(table), table_(table.table()), settings_(settings) {
  const std::size_t matrices = gram_columns(settings.kernel, table_.blocks, table_.features.cols()).size();
  const bool is_of_use = settings.dimensions > 0 ? learns_from_products(table_.features.cols(), settings.dimensions)
                                                 : table_.local_size == 0;
  if (is_of_use && fits_gram(table_.features.rows(), static_cast<Eigen::Index>(matrices))) {
    compute_gram(progress);
  }
}

JudgeTrainer::JudgeTrainer(const FeatureTable& table, const GramMatrices& gram, const JudgeSettings& settings,
                           int threads)
    : own_farm_(std::in_place, threads),
      own_(std::in_place, table, own_farm_->farm()),
      where_(*own_),
      table_(table),
      settings_(settings),
      gram_(&gram) {}

void JudgeTrainer::compute_gram(const Progress& progress) {
  const std::vector<GramTask> tasks = gram_tasks(table_, settings_.kernel);
  own_gram_ = unfilled_gram(table_, settings_.kernel);
  Job job;
  job.kind = kGramTasks;
  job.in_journal = false;
  job.stays_here = !where_.is_broadcast();
  job.context = [&](Packer& packer) { pack_gram_context(where_.ticket(), settings_.kernel, packer); };
  job.work = gram_work(table_, settings_.kernel);
  job.tasks = tasks.size();
  job.task = [&](std::size_t i) { return pack(tasks[i]); };
  job.deliver = [&](std::size_t i, const std::string& result) { put_strip(tasks[i], result, own_gram_); };
  job.broadcasts = [](std::string_view) { return true; };  // all ranks train with them
  where_.farm().run(job, telling(progress, "comparing objects", tasks.size()));
}

JudgeList JudgeTrainer::train(std::span<const std::uint32_t> objects, const Progress& progress) {
  const std::vector<TrainingPlan> trainings = {{{objects.begin(), objects.end()}, {}}};
  return do_trainings(trainings, progress).judges;
}

CalibratedJudges JudgeTrainer::train_calibrated(std::span<const std::uint32_t> objects, std::uint64_t seed,
                                                const Progress& progress) {
  std::vector<TrainingPlan> trainings = {{{objects.begin(), objects.end()}, {}}};
  std::ranges::move(calibration_folds(table_, objects, seed), std::back_inserter(trainings));
  return do_trainings(trainings, progress);
}

// The first training's judges are wanted, of the others their margins. All are one job: so nobody waits between them.
CalibratedJudges JudgeTrainer::do_trainings(std::span<const TrainingPlan> trainings, const Progress& progress) {
  const std::vector<JudgesTask> tasks = judges_tasks(table_, settings_.kernel, trainings);
  const auto made = std::make_shared<Trainings>(table_, *gram_, settings_,
                                                std::vector<TrainingPlan>(trainings.begin(), trainings.end()));
  JudgeCollector judges(*made, table_.categories.size());
  FoldCounter folds(table_);
  Job job;
  job.kind = kJudgesTasks;
  job.in_journal = false;
  job.stays_here = !where_.is_broadcast();
  job.context = [&](Packer& packer) { pack_trainings(where_.ticket(*gram_), settings_, trainings, packer); };
  job.work = judges_work(made);
  job.tasks = tasks.size();
  job.task = [&](std::size_t i) { return pack(tasks[i]); };
  job.deliver = [&](std::size_t i, const std::string& result) {
    const TrainingPlan& plan = trainings[tasks[i].training];
    if (plan.held_out.empty()) {
      judges.add(tasks[i], result);
    } else {
      const bool is_last =
          i + 1 == tasks.size() || tasks[i + 1].training != tasks[i].training || tasks[i + 1].is_of_known_judge();
      folds.add(plan, tasks[i], result, is_last);
    }
  };
  where_.farm().run(job, telling(progress, "training judges", tasks.size()));
  CalibratedJudges result{judges.take(), folds.calibration(), judges.take_known()};
  folds.calibrate(result.known);
  return result;
}

}  // namespace spincat
