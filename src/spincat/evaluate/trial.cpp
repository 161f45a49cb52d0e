#include "spincat/evaluate/trial.h"

#include <memory>
#include <optional>
#include <tuple>
#include <utility>

#include "spincat/describe/packed_matrix.h"
#include "spincat/describe/packed_settings.h"
#include "spincat/parallel/journal.h"
#include "spincat/parallel/packing.h"
#include "spincat/train/packed_table.h"

namespace spincat {

void fields(auto& archive, MessageOf<Trial> auto& trial) {
  auto& [confusion, by_views, named, right, wrong, known, unknown_objects, least_known] = trial;  // all of them
  archive(confusion, by_views, named, right, wrong, known, unknown_objects, least_known);
}

// Not what only people look at.
void fields(auto& archive, MessageOf<TestTable> auto& tested) {
  auto& [objects, rows_per_object, features, problems, kinds, seconds] = tested;  // all of them
  static_cast<void>(std::tie(kinds, seconds));
  archive(objects, rows_per_object, features, problems);
}

namespace {

// What trials need besides the table.
struct TrialContext {
  Settings settings;
  bool measure_confidence = false;
  TestTable unknown_objects;
  std::optional<TestTable> tested;
};

// The same, not copied.
struct TrialContextView {
  const Settings& settings;
  bool measure_confidence = false;
  const TestTable& unknown_objects;
  const TestTable* tested;
};

template <class T>
concept TrialNeeds = MessageOf<T, TrialContext> || MessageOf<T, TrialContextView>;

void fields(auto& archive, TrialNeeds auto& context) {
  auto& [settings, measure_confidence, unknown_objects, tested] = context;
  archive(settings, measure_confidence, unknown_objects, tested);
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
  const auto [judges, calibration, known] = measure_confidence ? trainer.train_calibrated(split.train, settings.seed)
                                                               : CalibratedJudges{trainer.train(split.train), {}, {}};
  const Tested tested{data};
  const std::vector<std::uint32_t> groups = view_counts(tested.views());
  Trial trial;
  trial.least_known = known.least;
  trial.confusion.assign(n, std::vector<std::uint32_t>(n, 0));
  trial.by_views.assign(groups.size(), trial.confusion);
  for (const std::uint32_t object : split.test) {
    const std::uint32_t truth = tested.category(object);
    std::vector<Ballot> ballots;
    for (std::uint32_t view = 0; view < tested.views(); ++view) {
      const std::vector<float> seen = judges.seen(tested.features(object, view));
      ballots.push_back(judges.vote_on(seen));
      if (measure_confidence) {
        const double confidence = calibration.probability(static_cast<double>(ballots.back().weakest_margin));
        (ballots.back().winner == truth ? trial.right : trial.wrong).push_back(confidence);
        trial.known.push_back(known.known(seen));
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
        trial.unknown_objects.push_back(known.known(judges.seen(features)));
      }
    }
  }
  return trial;
}

Trial unpack_trial(std::string_view result) {
  return unpack<Trial>(result);
}

void pack_trials(const TrialData& data, const TableTicket& ticket, const Settings& settings, bool measure_confidence,
                 Packer& packer) {
  packer(ticket, TrialContextView{settings, measure_confidence, data.unknown_objects, data.tested});
}

// The table by a hash of its features, and of its files nothing: they have done their part when they are described.
void pack_trials_identity(const TrialData& data, const Settings& settings, bool measure_confidence, Packer& packer) {
  const FeatureTable& table = data.table;
  const std::string_view features(reinterpret_cast<const char*>(table.features.data()),
                                  static_cast<std::size_t>(table.features.size()) * sizeof(float));
  packer(table, hash_of(features));
  packer(TrialContextView{settings, measure_confidence, data.unknown_objects, data.tested});
}

Work trial_work(const TrialData& data, const GramMatrices& gram, const Settings& settings, bool measure_confidence) {
  return [data, &gram, settings, measure_confidence](std::string_view bytes) {
    const auto split = unpack<Split>(bytes);
    JudgeTrainer trainer(data.table, gram, settings.judge, 1);
    return pack(run_trial(data, trainer, split, settings, measure_confidence));
  };
}

Work make_trial_work(std::string_view context, const RankState& kept) {
  Unpacker unpacker(context);
  check_ticket(unpacker.next<TableTicket>(), kept);
  const auto given = std::make_shared<const TrialContext>(unpacker.next<TrialContext>());
  const TrialData data{kept.table, given->tested ? &*given->tested : nullptr, given->unknown_objects};
  Work work = trial_work(data, kept.gram, given->settings, given->measure_confidence);
  return [given, work = std::move(work)](std::string_view task) { return work(task); };
}

}  // namespace spincat
