#include "spincat/evaluate/trial.h"

#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "spincat/parallel/journal.h"
#include "spincat/parallel/packing.h"
#include "spincat/settings/settings_json.h"
#include "spincat/train/table_familiarity.h"

namespace spincat {
namespace {

void pack_tested(Packer& packer, const TestTable& tested) {
  packer.add(static_cast<std::uint64_t>(tested.objects.size()));
  packer.add(static_cast<std::uint64_t>(tested.features.cols())).add(tested.rows_per_object);
  packer.add(std::span<const float>(tested.features.data(), static_cast<std::size_t>(tested.features.size())));
  for (std::size_t i = 0; i < tested.objects.size(); ++i) {
    packer.add(tested.objects[i].category).add(std::string_view(tested.problems[i]));
  }
}

TestTable unpack_tested(Unpacker& fields) {
  TestTable tested;
  const auto objects = fields.get<std::uint64_t>();
  const auto columns = fields.get<std::uint64_t>();
  tested.rows_per_object = fields.get<std::uint32_t>();
  const std::vector<float> features = fields.get_values<float>();
  tested.features = Eigen::Map<const FeatureMatrix>(
      features.data(), static_cast<Eigen::Index>(objects * tested.rows_per_object), static_cast<Eigen::Index>(columns));
  for (std::uint64_t i = 0; i < objects; ++i) {
    tested.objects.push_back({{}, fields.get<std::uint32_t>(), {}});
    tested.problems.emplace_back(fields.get_text());
  }
  return tested;
}

void pack_confusion(Packer& packer, const Confusion& confusion) {
  for (const std::vector<std::uint32_t>& row : confusion) {
    packer.add(std::span<const std::uint32_t>(row));
  }
}

Confusion unpack_confusion(Unpacker& fields, std::size_t categories) {
  Confusion confusion;
  for (std::size_t i = 0; i < categories; ++i) {
    confusion.push_back(fields.get_values<std::uint32_t>());
  }
  return confusion;
}

std::string pack(const Trial& trial) {
  const auto& [confusion, by_views, named, right, wrong, unknown_objects] = trial;
  Packer packer;
  pack_confusion(packer, confusion);
  packer.add(static_cast<std::uint64_t>(by_views.size()));
  for (const Confusion& of : by_views) {
    pack_confusion(packer, of);
  }
  packer.add(std::span<const std::uint32_t>(named));
  packer.add(std::span<const double>(right)).add(std::span<const double>(wrong));
  packer.add(std::span<const double>(unknown_objects));
  return packer.take();
}

// But for the table.
void pack_rest(const TrialData& data, const Settings& settings, bool measure_confidence, Packer& packer) {
  packer.add(settings_to_json(settings).dump()).add(measure_confidence).add(data.tested != nullptr);
  pack_tested(packer, data.unknown_objects);
  if (data.tested != nullptr) {
    pack_tested(packer, *data.tested);
  }
}

// What is tested: the objects of the table, or those of another one.
struct Tested {
  const TrialData& data;

  std::uint32_t views() const { return data.tested != nullptr ? data.tested->rows_per_object : data.table.tested_rows; }
  std::uint32_t category(std::uint32_t object) const {
    return data.tested != nullptr ? data.tested->objects[object].category : data.table.objects[object].category;
  }
  std::span<const float> features(std::uint32_t object, std::uint32_t view) const {
    return data.tested != nullptr ? data.tested->features_of(object, view) : data.table.features_of(object, view);
  }
};

// Votes summed over each run of so many views.
void count_groups(std::span<const Ballot> ballots, std::uint32_t views, std::uint32_t truth, Confusion& confusion) {
  for (std::size_t first = 0; first + views <= ballots.size(); first += views) {
    ++confusion[truth][sum_votes(ballots.subspan(first, views)).winner];
  }
}

}  // namespace

TrialData trial_data(const EvaluationData& data) {
  return {data.table, data.tested ? &*data.tested : nullptr, data.unknown_objects};
}

std::vector<std::uint32_t> view_counts(std::uint32_t views) {
  std::vector<std::uint32_t> counts;
  for (std::uint32_t count = 1; count < views; count *= 2) {
    counts.push_back(count);
  }
  if (!counts.empty()) {
    counts.push_back(views);
  }
  return counts;
}

Trial run_trial(const TrialData& data, JudgeTrainer& trainer, const Split& split, const Settings& settings,
                bool measure_confidence) {
  const FeatureTable& table = data.table;
  const std::size_t n = table.categories.size();
  const auto [judges, calibration] = measure_confidence ? trainer.train_calibrated(split.train, settings.seed)
                                                        : CalibratedJudges{trainer.train(split.train), {}};
  const Familiarity familiarity = measure_confidence ? familiarity_of(table, split.train) : Familiarity{};
  const auto confidence = [&, &calibration = calibration](const Ballot& ballot, std::span<const float> features) {
    return calibration.confidence(ballot, familiarity.of(features, ballot.winner));
  };
  const Tested tested{data};
  const std::vector<std::uint32_t> groups = view_counts(tested.views());
  Trial trial;
  trial.confusion.assign(n, std::vector<std::uint32_t>(n, 0));
  trial.by_views.assign(groups.size(), trial.confusion);
  for (const std::uint32_t object : split.test) {
    const std::uint32_t truth = tested.category(object);
    std::vector<Ballot> ballots;
    for (std::uint32_t view = 0; view < tested.views(); ++view) {
      const std::span<const float> features = tested.features(object, view);
      ballots.push_back(judges.vote(features));
      if (measure_confidence) {
        (ballots.back().winner == truth ? trial.right : trial.wrong).push_back(confidence(ballots.back(), features));
      }
    }
    trial.named.push_back(sum_votes(ballots).winner);
    ++trial.confusion[truth][trial.named.back()];
    for (std::size_t g = 0; g < groups.size(); ++g) {
      count_groups(ballots, groups[g], truth, trial.by_views[g]);
    }
  }
  for (std::uint32_t object = 0; measure_confidence && object < data.unknown_objects.objects.size(); ++object) {
    for (std::uint32_t view = 0; view < data.unknown_objects.rows_per_object; ++view) {
      if (data.unknown_objects.problems[object].empty()) {
        const std::span<const float> features = data.unknown_objects.features_of(object, view);
        trial.unknown_objects.push_back(confidence(judges.vote(features), features));
      }
    }
  }
  return trial;
}

std::string pack(const Split& split) {
  const auto& [train, test] = split;
  return Packer().add(std::span<const std::uint32_t>(train)).add(std::span<const std::uint32_t>(test)).take();
}

Trial unpack_trial(std::string_view result, std::size_t categories) {
  Unpacker fields(result);
  Trial trial;
  trial.confusion = unpack_confusion(fields, categories);
  const auto by_views = fields.get<std::uint64_t>();
  for (std::uint64_t i = 0; i < by_views; ++i) {
    trial.by_views.push_back(unpack_confusion(fields, categories));
  }
  trial.named = fields.get_values<std::uint32_t>();
  trial.right = fields.get_values<double>();
  trial.wrong = fields.get_values<double>();
  trial.unknown_objects = fields.get_values<double>();
  return trial;
}

void pack_trials(const TrialData& data, const TableTicket& expected, const Settings& settings, bool measure_confidence,
                 Packer& packer) {
  pack_ticket(expected, packer);
  pack_rest(data, settings, measure_confidence, packer);
}

// The table by a hash of its features, and of its files nothing: they have done their part when they are described.
void pack_trials_identity(const TrialData& data, const Settings& settings, bool measure_confidence, Packer& packer) {
  const FeatureTable& table = data.table;
  const std::vector<std::uint32_t> labels = table.object_labels();
  const std::string_view features(reinterpret_cast<const char*>(table.features.data()),
                                  static_cast<std::size_t>(table.features.size()) * sizeof(float));
  packer.add(static_cast<std::uint64_t>(table.categories.size())).add(std::span<const std::uint32_t>(labels));
  packer.add(std::span<const std::uint32_t>(table.blocks)).add(table.local_size).add(table.words).add(table.seed);
  packer.add(table.rows_per_object).add(table.tested_rows).add(table.parts).add(hash_of(features));
  pack_rest(data, settings, measure_confidence, packer);
}

Work trial_work(const TrialData& data, const GramMatrices& gram, const Settings& settings, bool measure_confidence) {
  return [data, &gram, settings, measure_confidence](std::string_view bytes) {
    Unpacker fields(bytes);
    Split split;
    split.train = fields.get_values<std::uint32_t>();
    split.test = fields.get_values<std::uint32_t>();
    JudgeTrainer trainer(data.table, gram, settings.judge, 1);
    return pack(run_trial(data, trainer, split, settings, measure_confidence));
  };
}

Work make_trial_work(std::string_view context, const RankState& kept) {
  Unpacker fields(context);
  check_ticket(fields, kept);
  const Settings settings = settings_from_json(nlohmann::json::parse(fields.get_text()));
  const bool measure_confidence = fields.get<bool>();
  const bool has_tested = fields.get<bool>();
  const auto unknown_objects = std::make_shared<TestTable>(unpack_tested(fields));
  const auto tested = has_tested ? std::make_shared<TestTable>(unpack_tested(fields)) : nullptr;
  Work work = trial_work({kept.table, tested.get(), *unknown_objects}, kept.gram, settings, measure_confidence);
  return [unknown_objects, tested, work = std::move(work)](std::string_view task) { return work(task); };
}

}  // namespace spincat
