// What ranks do for a trainer, and what they keep for it.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "spincat/describe/table_rows.h"
#include "spincat/judge/judge_list.h"
#include "spincat/judge/known_judge.h"
#include "spincat/parallel/packing.h"
#include "spincat/parallel/task.h"
#include "spincat/train/broadcast_rows.h"
#include "spincat/train/feature_table.h"
#include "spincat/train/trainings.h"

namespace spincat {

// The names of these kinds of work, as ranks tell each other.
inline constexpr const char* kTableTasks = "a table to keep";
inline constexpr const char* kGramTasks = "inner products";
inline constexpr const char* kJudgesTasks = "judges";

// What a rank keeps from one job to the next.
struct RankState {
  std::optional<TableRows> rows;   // of objects that were described, until they are a table
  std::uint64_t broadcast_id = 0;  // of the table; 0: there is none
  std::uint64_t rows_id = 0;       // of its rows, where they were taken as they came (BroadcastRows)
  FeatureTable table;
  GramMatrices gram;                 // of the table, strip by strip
  std::vector<bool> missing_strips;  // by gram_tasks(): not there yet
};

// Kept by the others, to train on it by other settings, too, each time under another id: of objects only their
// categories, and the features only where ranks do not have them.
void pack_table(const FeatureTable& table, std::uint64_t broadcast_id, const BroadcastRows& rows, Packer& packer);

// By which a rank knows whether it keeps what it should: it may have missed something.
struct TableTicket {
  std::uint64_t broadcast_id = 0;
  std::uint32_t matrices = 0;  // of inner products
};

void fields(auto& archive, MessageOf<TableTicket> auto& ticket) {
  auto& [broadcast_id, matrices] = ticket;
  archive(broadcast_id, matrices);
}

// What the rank keeps. Throws RunError when that is not what the ticket is for: it could not keep it.
const RankState& check_ticket(const TableTicket& ticket, const RankState& kept);

// One strip of one of the matrices of a GramMatrices.
struct GramTask {
  std::uint32_t matrix = 0;
  std::uint32_t strip = 0;
};

void fields(auto& archive, MessageOf<GramTask> auto& task) {
  auto& [matrix, strip] = task;
  archive(matrix, strip);
}

// All of them, the longest first.
std::vector<GramTask> gram_tasks(const FeatureTable& table, KernelKind kind);
// All of the table's, still to be filled.
GramMatrices unfilled_gram(const FeatureTable& table, KernelKind kind);
// Puts the result of such a task into it.
void put_strip(const GramTask& task, std::string_view result, GramMatrices& gram);
Work gram_work(const FeatureTable& table, KernelKind kind);

// Some judges of one of the trainings; none of the pairs: its judge of known and unknown.
struct JudgesTask {
  std::uint32_t training = 0;
  std::uint32_t first = 0;  // of all pairs
  std::uint32_t last = 0;

  bool is_of_known_judge() const { return first == last; }
};

void fields(auto& archive, MessageOf<JudgesTask> auto& task) {
  auto& [training, first, last] = task;
  archive(training, first, last);
}

// Margins of a fold's judge of known and unknown.
struct KnownMargins {
  std::vector<double> known;      // of the held-out objects and their copies
  std::vector<double> strangers;  // of the background that was held out
};

void fields(auto& archive, MessageOf<KnownMargins> auto& margins) {
  auto& [known, strangers] = margins;
  archive(known, strangers);
}

std::vector<JudgesTask> judges_tasks(const FeatureTable& table, KernelKind kind,
                                     std::span<const TrainingPlan> trainings);
// Of a training that folds: puts the judges into `list`, from judge `first` on.
void put_folded(std::string_view result, std::uint32_t first, JudgeList& list);
// Its judge of known and unknown, not yet calibrated.
KnownJudge unpack_known_judge(std::string_view result);
// Of one that does not.
std::vector<Judge> unpack_judges(std::string_view result);
// Margins of the judged objects: a row for each of `objects` (or of their views), a column for each judge of the task.
FeatureMatrix unpack_margins(std::string_view result, std::size_t objects);
void pack_gram_context(const TableTicket& ticket, KernelKind kernel, Packer& packer);
void pack_trainings(const TableTicket& ticket, const JudgeSettings& settings, std::span<const TrainingPlan> trainings,
                    Packer& packer);
Work judges_work(std::shared_ptr<Trainings> trainings);

// The same works on other ranks, from what they keep.
Work make_table_work(std::string_view context, RankState& kept);
RankWork make_gram_work(std::string_view context, RankState& kept);
Work make_judges_work(std::string_view context, const RankState& kept);

}  // namespace spincat
