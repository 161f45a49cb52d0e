// The trainings of one job.
#pragma once

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "spincat/train/training.h"

namespace spincat {

// A training, and the objects whose margins are wanted; with none, the judges themselves are.
struct TrainingPlan {
  std::vector<std::uint32_t> train;
  std::vector<std::uint32_t> held_out;
  std::vector<std::uint32_t> held_out_background = {};  // rows of the table
};

// What the judges of each training have in common is made when it is first needed: a rank may have none of a training.
// Several threads at once may ask.
class Trainings {
 public:
  // `table` and `gram` must outlive this object.
  Trainings(const FeatureTable& table, const GramMatrices& gram, const JudgeSettings& settings,
            std::vector<TrainingPlan> plans)
      : table_(table), gram_(gram), settings_(settings), plans_(std::move(plans)), made_(plans_.size()) {}

  const FeatureTable& table() const { return table_; }
  const TrainingPlan& plan(std::size_t i) const { return plans_.at(i); }

  const Training& training(std::size_t i) {
    Made& made = made_.at(i);
    std::call_once(made.once, [&] { made.training.emplace(table_, gram_, plans_[i].train, settings_); });
    return *made.training;
  }

 private:
  struct Made {
    std::once_flag once;
    std::optional<Training> training;
  };

  const FeatureTable& table_;
  const GramMatrices& gram_;
  const JudgeSettings settings_;
  const std::vector<TrainingPlan> plans_;
  std::vector<Made> made_;
};

}  // namespace spincat
