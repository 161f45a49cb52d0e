#include "spincat/train/train_tasks.h"

#include <algorithm>
#include <optional>
#include <tuple>
#include <utility>

#include "spincat/error.h"

namespace spincat {
namespace {

template <class Matrix>
void pack_matrix(Packer& packer, const Matrix& matrix) {
  packer.add(static_cast<std::uint64_t>(matrix.rows())).add(static_cast<std::uint64_t>(matrix.cols()));
  packer.add(std::span<const float>(matrix.data(), static_cast<std::size_t>(matrix.size())));
}

template <class Matrix>
Matrix unpack_matrix(Unpacker& fields) {
  const auto rows = static_cast<Eigen::Index>(fields.get<std::uint64_t>());
  const auto columns = static_cast<Eigen::Index>(fields.get<std::uint64_t>());
  Matrix matrix(rows, columns);
  fields.get_values_into(std::span<float>(matrix.data(), static_cast<std::size_t>(matrix.size())));
  return matrix;
}

void pack_judge(Packer& packer, const Judge& judge) {
  const auto& [rows, coefficients, bias] = judge;
  packer.add(std::span<const std::uint32_t>(rows)).add(std::span<const double>(coefficients)).add(bias);
}

Judge unpack_judge(Unpacker& fields) {
  Judge judge;
  judge.rows = fields.get_values<std::uint32_t>();
  judge.coefficients = fields.get_values<double>();
  judge.bias = fields.get<float>();
  return judge;
}

void pack_folded(Packer& packer, const FoldedJudge& judge) {
  const auto& [weights, bias, support_vectors] = judge;
  packer.add(bias).add(support_vectors);
  packer.add(std::span<const float>(weights.data(), static_cast<std::size_t>(weights.size())));
}

std::string do_judges(Trainings& trainings, std::string_view bytes) {
  Unpacker fields(bytes);
  const auto number = fields.get<std::uint32_t>();
  const auto first = fields.get<std::uint32_t>();
  const auto last = fields.get<std::uint32_t>();
  const Training& training = trainings.training(number);
  const std::vector<CategoryPair> pairs = all_pairs(static_cast<std::uint32_t>(trainings.table().categories.size()));
  const std::vector<Judge> judges = training.train(std::span(pairs).subspan(first, last - first));
  Packer packer;
  const std::vector<std::uint32_t>& held_out = trainings.plan(number).held_out;
  if (!held_out.empty()) {
    pack_matrix(packer, training.margins(judges, held_out));
    return packer.take();
  }
  if (training.folds()) {
    constexpr std::size_t kBesidesWeights = 16;  // bytes of a judge
    const auto weights = static_cast<std::size_t>(trainings.table().features.cols());
    packer.reserve(judges.size() * (weights * sizeof(float) + kBesidesWeights));
  }
  for (const Judge& judge : judges) {
    if (training.folds()) {
      pack_folded(packer, training.fold(judge));
    } else {
      pack_judge(packer, judge);
    }
  }
  return packer.take();
}

FeatureTable unpack_table(Unpacker& fields, std::uint64_t number, std::optional<TableRows> rows) {
  FeatureTable table;
  table.number = number;
  table.categories.resize(fields.get<std::uint32_t>());
  for (const std::uint32_t label : fields.get_values<std::uint32_t>()) {
    table.objects.push_back({{}, label, {}});
  }
  table.blocks = fields.get_values<std::uint32_t>();
  table.local_size = fields.get<std::uint32_t>();
  table.words = fields.get<std::uint32_t>();
  table.seed = fields.get<std::uint64_t>();
  table.rows_per_object = fields.get<std::uint32_t>();
  table.tested_rows = fields.get<std::uint32_t>();
  table.parts = fields.get<std::uint32_t>();
  table.described_as = fields.get_values<std::uint32_t>();
  if (table.described_as.empty()) {
    table.features = unpack_matrix<FeatureMatrix>(fields);
  } else if (rows) {
    table.features = rows->take(table.described_as);
  } else {
    throw RunError("the rows of a feature table are not there");
  }
  return table;
}

}  // namespace

void pack_table(const FeatureTable& table, std::uint64_t shared_as, Packer& packer) {
  // Does not compile when a member is forgotten.
  const auto& [objects, categories, skipped, features, blocks, local_size, words, seed, rows_per_object, tested_rows,
               parts, encoding, kinds, seconds, described_as, number] = table;
  static_cast<void>(std::tie(skipped, encoding, kinds, seconds));  // not for other ranks
  packer.add(shared_as).add(number);
  packer.add(static_cast<std::uint32_t>(categories.size()));
  const std::vector<std::uint32_t> labels = table.object_labels();
  packer.add(std::span<const std::uint32_t>(labels)).add(std::span<const std::uint32_t>(blocks));
  packer.add(local_size).add(words).add(seed).add(rows_per_object).add(tested_rows).add(parts);
  packer.add(std::span<const std::uint32_t>(described_as));
  if (described_as.empty()) {
    pack_matrix(packer, features);
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

std::string pack(const GramTask& task) {
  return Packer().add(task.matrix).add(task.strip).take();
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
  Unpacker fields(result);
  put_gram_strip(unpack_matrix<Eigen::MatrixXf>(fields), task.strip, gram.blocks[task.matrix]);
}

Work gram_work(const FeatureTable& table, KernelKind kind) {
  return [&table, columns = gram_columns(kind, table.blocks, table.features.cols())](std::string_view bytes) {
    Unpacker fields(bytes);
    const auto [first, count] = columns.at(fields.get<std::uint32_t>());
    Packer packer;
    pack_matrix(packer, gram_strip(table.features.middleCols(first, count), fields.get<std::uint32_t>()));
    return packer.take();
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
  }
  return tasks;
}

std::string pack(const JudgesTask& task) {
  return Packer().add(task.training).add(task.first).add(task.last).take();
}

void put_folded(std::string_view result, std::uint32_t first, JudgeList& list) {
  Unpacker fields(result);
  for (Eigen::Index l = first; !fields.empty(); ++l) {
    list.bias[l] = fields.get<float>();
    list.support_vectors.at(static_cast<std::size_t>(l)) = fields.get<std::uint32_t>();
    fields.get_values_into(std::span<float>(list.weights.row(l).data(), static_cast<std::size_t>(list.weights.cols())));
  }
}

std::vector<Judge> unpack_judges(std::string_view result) {
  std::vector<Judge> judges;
  Unpacker fields(result);
  while (!fields.empty()) {
    judges.push_back(unpack_judge(fields));
  }
  return judges;
}

FeatureMatrix unpack_margins(std::string_view result, std::size_t objects) {
  Unpacker fields(result);
  auto margins = unpack_matrix<FeatureMatrix>(fields);
  if (margins.rows() != static_cast<Eigen::Index>(objects)) {
    throw RunError("a message between ranks holds margins of other objects");
  }
  return margins;
}

void pack_trainings(const TableTicket& expected, const JudgeSettings& settings, std::span<const TrainingPlan> trainings,
                    Packer& packer) {
  const auto& [kernel, c, class_weights] = settings;
  pack_ticket(expected, packer);
  packer.add(kernel).add(c).add(class_weights);
  for (const auto& [trained, judged] : trainings) {
    packer.add(std::span<const std::uint32_t>(trained)).add(std::span<const std::uint32_t>(judged));
  }
}

Work judges_work(std::shared_ptr<Trainings> trainings) {
  return [trainings = std::move(trainings)](std::string_view task) { return do_judges(*trainings, task); };
}

void pack_ticket(const TableTicket& expected, Packer& packer) {
  packer.add(expected.shared_as).add(expected.matrices);
}

const RankState& check_ticket(Unpacker& fields, const RankState& kept) {
  const bool all_strips = std::ranges::find(kept.missing_strips, true) == kept.missing_strips.end();
  const auto shared_as = fields.get<std::uint64_t>();
  const auto matrices = fields.get<std::uint32_t>();
  if (shared_as == 0 || kept.shared_as != shared_as || kept.gram.blocks.size() != matrices || !all_strips) {
    throw RunError("this rank could not keep what it was given");
  }
  return kept;
}

Work make_table_work(std::string_view context, RankState& kept) {
  Unpacker fields(context);
  const auto shared_as = fields.get<std::uint64_t>();
  const auto number = fields.get<std::uint64_t>();
  std::optional<TableRows> rows = std::exchange(kept.rows, std::nullopt);
  const bool has_table = number != 0 && !rows && kept.shared_as != 0 && kept.table.number == number;
  if (has_table) {
    kept.gram = {};
    kept.missing_strips.clear();
  } else {
    kept = {};  // first: both at once may be too much
    kept.table = unpack_table(fields, number, std::move(rows));
  }
  kept.shared_as = shared_as;
  return {};
}

RankWork make_gram_work(std::string_view context, RankState& kept) {
  Unpacker fields(context);
  const FeatureTable& table = check_ticket(fields, kept).table;
  const auto kind = fields.get<KernelKind>();
  const std::vector<GramTask> tasks = gram_tasks(table, kind);
  kept.gram = unfilled_gram(table, kind);
  kept.missing_strips.assign(tasks.size(), true);
  RankWork work = gram_work(table, kind);
  work.keep = [&kept, tasks](std::size_t i, std::string_view result) {
    put_strip(tasks.at(i), result, kept.gram);
    kept.missing_strips[i] = false;
  };
  return work;
}

Work make_judges_work(std::string_view context, const RankState& kept) {
  Unpacker fields(context);
  check_ticket(fields, kept);
  JudgeSettings settings;
  settings.kernel = fields.get<KernelKind>();
  settings.c = fields.get<double>();
  settings.class_weights = fields.get<bool>();
  std::vector<TrainingPlan> trainings;
  while (!fields.empty()) {
    TrainingPlan& plan = trainings.emplace_back();
    plan.train = fields.get_values<std::uint32_t>();
    plan.held_out = fields.get_values<std::uint32_t>();
  }
  return judges_work(std::make_shared<Trainings>(kept.table, kept.gram, settings, std::move(trainings)));
}

}  // namespace spincat
