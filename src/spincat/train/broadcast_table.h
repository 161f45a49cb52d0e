// Private to the library, not installed: a feature table, and whether the ranks of a farm train on it.
#pragma once

#include <cstddef>
#include <cstdint>

#include "spincat/judge/gram.h"
#include "spincat/parallel/task_farm.h"
#include "spincat/train/broadcast_rows.h"
#include "spincat/train/feature_table.h"
#include "spincat/train/train_tasks.h"

namespace spincat {

// What is passed by reference must outlive this object. A farm's ranks keep one table at a time.
class BroadcastTable {
 public:
  // Gives the table to the other ranks where they have its rows, or where so many trainings make it worth it
  // (worth_broadcasting.h).
  BroadcastTable(const FeatureTable& table, TaskFarm& farm, const BroadcastRows& rows = {}, std::size_t trainings = 0);

  const FeatureTable& table() const { return table_; }
  TaskFarm& farm() const { return farm_; }
  // Whether all ranks train on it; if not, its jobs stay here.
  bool is_broadcast() const { return id_ != 0; }
  // What other ranks must keep besides it: the inner products, or nothing of them.
  TableTicket ticket(const GramMatrices& gram = {}) const;

 private:
  const FeatureTable& table_;
  TaskFarm& farm_;
  std::uint64_t id_ = 0;
};

}  // namespace spincat
