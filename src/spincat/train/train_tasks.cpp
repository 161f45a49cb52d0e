#include "spincat/train/train_tasks.h"

#include <algorithm>
#include <optional>
#include <tuple>
#include <utility>

#include "spincat/describe/packed_matrix.h"
#include "spincat/error.h"
#include "spincat/train/packed_table.h"

namespace spincat {

void fields(auto& archive, MessageOf<Judge> auto& judge) {
  auto& [rows, coefficients, bias] = judge;  // does not compile when a member is forgotten
  archive(rows, coefficients, bias);
}

void fields(auto& archive, MessageOf<FoldedJudge> auto& judge) {
  auto& [weights, bias, support_vectors] = judge;  // all of them
  archive(weights, bias, support_vectors);
}

void fields(auto& archive, MessageOf<KnownJudge> auto& judge) {
  auto& [weights, bias, scaling, least] = judge;  // does not compile when a member is forgotten
  static_cast<void>(std::tie(scaling, least));
  archive(weights, bias);
}

void fields(auto& archive, MessageOf<JudgeSettings> auto& settings) {
  auto& [kernel, dimensions, c, class_weights] = settings;  // all of them
  archive(kernel, dimensions, c, class_weights);
}

void fields(auto& archive, MessageOf<TrainingPlan> auto& plan) {
  auto& [train, held_out, held_out_background] = plan;
  archive(train, held_out, held_out_background);
}

namespace {

// What a table begins with, before the table itself; its features follow where the ranks do not have the rows.
struct TableHead {
  std::uint64_t broadcast_id = 0;
  BroadcastRows rows;
};

void fields(auto& archive, MessageOf<TableHead> auto& head) {
  auto& [broadcast_id, rows] = head;
  archive(broadcast_id, rows);
}

struct GramContext {
  TableTicket ticket;
  KernelKind kernel = KernelKind::linear;
};

void fields(auto& archive, MessageOf<GramContext> auto& context) {
  auto& [ticket, kernel] = context;
  archive(ticket, kernel);
}

struct TrainingsContext {
  TableTicket ticket;
  JudgeSettings settings;
  std::vector<TrainingPlan> trainings;
};

void fields(auto& archive, MessageOf<TrainingsContext> auto& context) {
  auto& [ticket, settings, trainings] = context;
  archive(ticket, settings, trainings);
}

std::string do_known_judge(const Training& training, const TrainingPlan& plan) {
  const KnownJudge judge = training.train_known_judge(plan.held_out_background);
  if (plan.held_out.empty()) {
    return pack(judge);
  }
  return pack(KnownMargins{training.known_margins(judge, training.table().rows_of(plan.held_out)),
                           training.known_margins(judge, plan.held_out_background)});
}

std::string do_judges(Trainings& trainings, std::string_view bytes) {
  const auto task = unpack<JudgesTask>(bytes);
  const auto [number, first, last] = task;
  const Training& training = trainings.training(number);
  if (task.is_of_known_judge()) {
    return do_known_judge(training, trainings.plan(number));
  }
  const std::vector<CategoryPair> pairs = all_pairs(static_cast<std::uint32_t>(trainings.table().categories.size()));
  const std::vector<Judge> judges = training.train(std::span(pairs).subspan(first, last - first));
  const std::vector<std::uint32_t>& held_out = trainings.plan(number).held_out;
  if (!held_out.empty()) {
    return pack(training.margins(judges, held_out));
  }
  Packer packer;
  if (training.folds()) {
    constexpr std::size_t kBesidesWeights = 32;  // bytes of a judge
    const std::size_t weights = training.seen_length();
    packer.reserve(judges.size() * (weights * sizeof(float) + kBesidesWeights));
  }
  for (const Judge& judge : judges) {
    if (training.folds()) {
      packer(training.fold(judge));
    } else {
      packer(judge);
    }
  }
  return packer.take();
}

}  // namespace

void pack_table(const FeatureTable& table, std::uint64_t broadcast_id, const BroadcastRows& rows, Packer& packer) {
  packer(TableHead{broadcast_id, rows}, table);
  if (rows.id == 0) {
    packer(table.features);
  }
}

std::vector<GramTask> gram_tasks(const FeatureTable& table, KernelKind kind) {
  const std::size_t matrices = gram_columns(kind, table.blocks, table.features.cols()).size();
  const auto strips = static_cast<std::uint32_t>(gram_strips(table.features.rows()));
  std::vector<GramTask> tasks;
  for (std::uint32_t s = strips; s-- > 0;) {
    for (std::uint32_t matrix = 0; matrix < matrices; ++matrix) {
      tasks.push_back({matrix, s});
    }
  }
  return tasks;
}

GramMatrices unfilled_gram(const FeatureTable& table, KernelKind kind) {
  GramMatrices gram;
  const Eigen::Index rows = table.features.rows();
  for (std::size_t i = 0; i < gram_columns(kind, table.blocks, table.features.cols()).size(); ++i) {
    gram.blocks.emplace_back(rows, rows);
  }
  return gram;
}

void put_strip(const GramTask& task, std::string_view result, GramMatrices& gram) {
  put_gram_strip(unpack<Eigen::MatrixXf>(result), task.strip, gram.blocks[task.matrix]);
}

Work gram_work(const FeatureTable& table, KernelKind kind) {
  return [&table, columns = gram_columns(kind, table.blocks, table.features.cols())](std::string_view bytes) {
    const auto [matrix, strip] = unpack<GramTask>(bytes);
    const auto [first, count] = columns.at(matrix);
    return pack(gram_strip(table.features.middleCols(first, count), strip));
  };
}

std::vector<JudgesTask> judges_tasks(const FeatureTable& table, KernelKind kind,
                                     std::span<const TrainingPlan> trainings) {
  // Short tasks, so that the last ones keep nobody waiting for long; margins take less time than folding.
  constexpr std::uint32_t kJudges = 32;
  constexpr std::uint32_t kJudgedJudges = 96;
  const auto categories = static_cast<std::uint32_t>(table.categories.size());
  const std::uint32_t pairs = categories * (categories - 1) / 2;
  std::vector<JudgesTask> tasks;
  for (std::uint32_t training = 0; training < trainings.size(); ++training) {
    // The margins of all judges with a kernel of their own need the same row of it, which takes longest.
    const bool together = kind != KernelKind::linear && !trainings[training].held_out.empty();
    const std::uint32_t each = together ? pairs : trainings[training].held_out.empty() ? kJudges : kJudgedJudges;
    for (std::uint32_t first = 0; first < pairs; first += each) {
      tasks.push_back({training, first, std::min(first + each, pairs)});
    }
    if (table.background_rows > 0) {
      tasks.push_back({training, 0, 0});
    }
  }
  return tasks;
}

void put_folded(std::string_view result, std::uint32_t first, JudgeList& list) {
  Unpacker unpacker(result);
  for (Eigen::Index l = first; !unpacker.empty(); ++l) {
    const auto judge = unpacker.next<FoldedJudge>();
    if (judge.weights.size() != list.weights.cols()) {
      throw RunError("a message between ranks holds judges of other features");
    }
    list.bias[l] = judge.bias;
    list.support_vectors.at(static_cast<std::size_t>(l)) = judge.support_vectors;
    list.weights.row(l) = judge.weights;
  }
}

KnownJudge unpack_known_judge(std::string_view result) {
  return unpack<KnownJudge>(result);
}

std::vector<Judge> unpack_judges(std::string_view result) {
  std::vector<Judge> judges;
  Unpacker unpacker(result);
  while (!unpacker.empty()) {
    judges.push_back(unpacker.next<Judge>());
  }
  return judges;
}

FeatureMatrix unpack_margins(std::string_view result, std::size_t objects) {
  auto margins = unpack<FeatureMatrix>(result);
  if (margins.rows() != static_cast<Eigen::Index>(objects)) {
    throw RunError("a message between ranks holds margins of other objects");
  }
  return margins;
}

void pack_gram_context(const TableTicket& ticket, KernelKind kernel, Packer& packer) {
  packer(GramContext{ticket, kernel});
}

void pack_trainings(const TableTicket& ticket, const JudgeSettings& settings, std::span<const TrainingPlan> trainings,
                    Packer& packer) {
  packer(TrainingsContext{ticket, settings, {trainings.begin(), trainings.end()}});
}

Work judges_work(std::shared_ptr<Trainings> trainings) {
  return [trainings = std::move(trainings)](std::string_view task) { return do_judges(*trainings, task); };
}

const RankState& check_ticket(const TableTicket& ticket, const RankState& kept) {
  const auto& [broadcast_id, matrices] = ticket;
  const bool all_strips = std::ranges::find(kept.missing_strips, true) == kept.missing_strips.end();
  if (broadcast_id == 0 || kept.broadcast_id != broadcast_id || kept.gram.blocks.size() != matrices || !all_strips) {
    throw RunError("this rank could not keep what it was given");
  }
  return kept;
}

Work make_table_work(std::string_view context, RankState& kept) {
  Unpacker unpacker(context);
  const auto [broadcast_id, sent] = unpacker.next<TableHead>();
  std::optional<TableRows> rows = std::exchange(kept.rows, std::nullopt);
  const bool has_table = sent.id != 0 && !rows && kept.broadcast_id != 0 && kept.rows_id == sent.id;
  if (has_table) {
    kept.gram = {};
    kept.missing_strips.clear();
  } else {
    kept = {};  // first: both at once may be too much
    unpacker(kept.table);
    if (sent.id == 0) {
      unpacker(kept.table.features);
    } else if (rows) {
      kept.table.features = rows->take(sent.objects);
    } else {
      throw RunError("the rows of a feature table are not there");
    }
    kept.rows_id = sent.id;
  }
  kept.broadcast_id = broadcast_id;
  return {};
}

RankWork make_gram_work(std::string_view context, RankState& kept) {
  const auto [ticket, kernel] = unpack<GramContext>(context);
  const FeatureTable& table = check_ticket(ticket, kept).table;
  const std::vector<GramTask> tasks = gram_tasks(table, kernel);
  kept.gram = unfilled_gram(table, kernel);
  kept.missing_strips.assign(tasks.size(), true);
  RankWork work = gram_work(table, kernel);
  work.keep = [&kept, tasks](std::size_t i, std::string_view result) {
    put_strip(tasks.at(i), result, kept.gram);
    kept.missing_strips[i] = false;
  };
  return work;
}

Work make_judges_work(std::string_view context, const RankState& kept) {
  auto [ticket, settings, trainings] = unpack<TrainingsContext>(context);
  check_ticket(ticket, kept);
  return judges_work(std::make_shared<Trainings>(kept.table, kept.gram, settings, std::move(trainings)));
}

}  // namespace spincat
