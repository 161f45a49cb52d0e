#include "spincat/train/worth_broadcasting.h"

#include "spincat/train/calibration_folds.h"

namespace spincat {

std::size_t count_trainings(std::size_t trainings, bool calibrated) {
  return trainings * static_cast<std::size_t>(calibrated ? 1 + kCalibrationFolds : 1);
}

// Rough: a core does 10^10 products a second, and 10^9 bytes a second leave this process.
bool worth_broadcasting(const TableSize& table, std::size_t trainings, const TaskFarm& farm) {
  if (farm.ranks() < 2) {
    return false;
  }
  const auto rows = static_cast<double>(table.rows);
  const auto length = static_cast<double>(table.length);
  const auto categories = static_cast<double>(table.categories);
  const auto objects = static_cast<double>(table.objects);
  const double gram = 0.5 * rows * rows * length;
  const double training = length * categories * (rows + 0.5 * categories * objects / kCalibrationFolds);
  const double seconds_here = (gram + static_cast<double>(trainings) * training) / 1e10 / farm.threads();
  const double bytes = 4.0 * (rows * length + rows * rows);
  const double seconds_sending = bytes * (farm.ranks() - 1) / 1e9;
  return seconds_here > farm.policy().gain_of_broadcast * seconds_sending;
}

}  // namespace spincat
