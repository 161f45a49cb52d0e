#include "spincat/train/broadcast_table.h"

#include "spincat/train/worth_broadcasting.h"

namespace spincat {

BroadcastTable::BroadcastTable(const FeatureTable& table, TaskFarm& farm, const BroadcastRows& rows,
                               std::size_t trainings)
    : table_(table), farm_(farm) {
  const TableSize size{table.objects.size(), static_cast<std::size_t>(table.features.rows()),
                       static_cast<std::size_t>(table.features.cols()), table.categories.size()};
  if (farm.ranks() > 1 && (rows.id != 0 || worth_broadcasting(size, trainings, farm))) {
    id_ = next_broadcast_id();
    farm.broadcast(kTableTasks, [&](Packer& packer) { pack_table(table, id_, rows, packer); });
  }
}

TableTicket BroadcastTable::ticket(const GramMatrices& gram) const {
  return {id_, static_cast<std::uint32_t>(gram.blocks.size())};
}

}  // namespace spincat
