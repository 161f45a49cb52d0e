// One trial of an evaluation.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "spincat/dataset/splits.h"
#include "spincat/evaluate/evaluation_data.h"
#include "spincat/judge/kernel.h"
#include "spincat/parallel/packing.h"
#include "spincat/parallel/task.h"
#include "spincat/train/judge_trainer.h"
#include "spincat/train/train_tasks.h"

namespace spincat {

// The name of this kind of work, as ranks tell each other.
inline constexpr const char* kTrialTasks = "splits";

// What trials look at of an evaluation's data.
struct TrialData {
  const FeatureTable& table;
  const TestTable* tested;  // none: objects of the table
  const TestTable& unknown_objects;
};
TrialData trial_data(const EvaluationData& data);

// What came of one trial.
struct Trial {
  Confusion confusion;
  std::vector<Confusion> by_views;   // for each of view_counts(): votes summed over so many views of an object
  std::vector<std::uint32_t> named;  // for each of split.test: the category it was given
  // Where confidence is measured: that in the tested objects, by whether they were named right; how known these are,
  // and how known unknown objects are; and what is the least for an object not to be turned away.
  std::vector<double> right;
  std::vector<double> wrong;
  std::vector<double> known;
  std::vector<double> unknown_objects;
  double least_known = 0.0;
};

// Over how many views votes are summed, of so many that there are of an object: 1, 2, 4, ..., and all. Nothing where
// objects are tested themselves.
std::vector<std::uint32_t> view_counts(std::uint32_t views);

// Trains the judges on the objects `split.train` of the table and lets them vote on the tested objects `split.test`.
// The votes on all views of an object are summed; confidences are of single views. `trainer` trains on data.table.
// Deterministic.
Trial run_trial(const TrialData& data, JudgeTrainer& trainer, const Split& split, const Settings& settings,
                bool measure_confidence);

// Trials as tasks: a split is one. They need what a trainer has given to all ranks (train_tasks.h), and of the data
// what is only tested.
void fields(auto& archive, MessageOf<Split> auto& split) {
  auto& [train, test] = split;
  archive(train, test);
}

Trial unpack_trial(std::string_view result);
void pack_trials(const TrialData& data, const TableTicket& ticket, const Settings& settings, bool measure_confidence,
                 Packer& packer);
// All that their results depend on but the splits.
void pack_trials_identity(const TrialData& data, const Settings& settings, bool measure_confidence, Packer& packer);
Work trial_work(const TrialData& data, const GramMatrices& gram, const Settings& settings, bool measure_confidence);
Work make_trial_work(std::string_view context, const RankState& kept);

}  // namespace spincat
