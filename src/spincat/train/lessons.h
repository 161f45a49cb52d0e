// Private to the library, not installed: the trainings of one job.
#pragma once

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "spincat/train/lesson.h"

namespace spincat {

// A training, and the objects whose margins are wanted; with none, the judges themselves are.
struct LessonPlan {
  std::vector<std::uint32_t> taught;
  std::vector<std::uint32_t> judged;
};

// What the judges of each training have in common is made when it is first needed: a rank may have none of a lesson.
// Several threads at once may ask.
class Lessons {
 public:
  // `table` and `gram` must outlive this object.
  Lessons(const FeatureTable& table, const SharedGram& gram, const JudgeSettings& settings,
          std::vector<LessonPlan> plans)
      : table_(table), gram_(gram), settings_(settings), plans_(std::move(plans)), made_(plans_.size()) {}

  const FeatureTable& table() const { return table_; }
  const LessonPlan& plan(std::size_t i) const { return plans_.at(i); }

  const Lesson& lesson(std::size_t i) {
    Made& made = made_.at(i);
    std::call_once(made.once, [&] { made.lesson.emplace(table_, gram_, plans_[i].taught, settings_); });
    return *made.lesson;
  }

 private:
  struct Made {
    std::once_flag once;
    std::optional<Lesson> lesson;
  };

  const FeatureTable& table_;
  const SharedGram& gram_;
  const JudgeSettings settings_;
  const std::vector<LessonPlan> plans_;
  std::vector<Made> made_;
};

}  // namespace spincat
