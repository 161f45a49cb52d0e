#include "spincat/pipeline/trial.h"

#include <nlohmann/json.hpp>

#include "spincat/parallel/packing.h"
#include "spincat/pipeline/settings_json.h"

namespace spincat {
namespace {

void pack_tested(Packer& packer, const TestTable& tested) {
  packer.add(static_cast<std::uint64_t>(tested.objects.size()));
  packer.add(static_cast<std::uint64_t>(tested.features.cols()));
  packer.add(std::span<const float>(tested.features.data(), static_cast<std::size_t>(tested.features.size())));
  for (std::size_t i = 0; i < tested.objects.size(); ++i) {
    packer.add(tested.objects[i].category).add(std::string_view(tested.problems[i]));
  }
}

TestTable unpack_tested(Unpacker& fields) {
  TestTable tested;
  const auto objects = fields.get<std::uint64_t>();
  const auto columns = fields.get<std::uint64_t>();
  const std::vector<float> features = fields.get_values<float>();
  tested.features = Eigen::Map<const FeatureMatrix>(features.data(), static_cast<Eigen::Index>(objects),
                                                    static_cast<Eigen::Index>(columns));
  for (std::uint64_t i = 0; i < objects; ++i) {
    tested.objects.push_back({{}, fields.get<std::uint32_t>(), {}});
    tested.problems.emplace_back(fields.get_text());
  }
  return tested;
}

std::string pack(const Trial& trial) {
  const auto& [confusion, named, right, wrong, strangers] = trial;
  Packer packer;
  for (const std::vector<std::uint32_t>& row : confusion) {
    packer.add(std::span<const std::uint32_t>(row));
  }
  packer.add(std::span<const std::uint32_t>(named));
  packer.add(std::span<const double>(right)).add(std::span<const double>(wrong));
  packer.add(std::span<const double>(strangers));
  return packer.take();
}

}  // namespace

Trial run_trial(const EvaluationData& data, Teacher& teacher, const Split& split, const Settings& settings,
                bool measure_confidence) {
  const FeatureTable& table = data.table;
  const std::size_t n = table.categories.size();
  const JudgeList judges = teacher.teach(split.train);
  Calibration calibration;
  Familiarity familiarity;
  if (measure_confidence) {
    familiarity = familiarity_of(table, split.train);
    calibration = teacher.calibrate(split.train, settings.seed);
  }
  const auto confidence = [&](const Ballot& ballot, std::span<const float> features) {
    return calibration.confidence(ballot, familiarity.of(features, ballot.winner));
  };
  Trial trial;
  trial.confusion.assign(n, std::vector<std::uint32_t>(n, 0));
  for (const std::uint32_t object : split.test) {
    const std::span<const float> features = data.tested ? data.tested->features_of(object) : table.features_of(object);
    const Ballot ballot = judges.vote(features);
    const std::uint32_t truth = data.tested ? data.tested->objects[object].category : table.objects[object].category;
    ++trial.confusion[truth][ballot.winner];
    trial.named.push_back(ballot.winner);
    if (measure_confidence) {
      (ballot.winner == truth ? trial.right : trial.wrong).push_back(confidence(ballot, features));
    }
  }
  for (std::uint32_t object = 0; measure_confidence && object < data.strangers.objects.size(); ++object) {
    if (data.strangers.problems[object].empty()) {
      const std::span<const float> features = data.strangers.features_of(object);
      trial.strangers.push_back(confidence(judges.vote(features), features));
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
  for (std::size_t i = 0; i < categories; ++i) {
    trial.confusion.push_back(fields.get_values<std::uint32_t>());
  }
  trial.named = fields.get_values<std::uint32_t>();
  trial.right = fields.get_values<double>();
  trial.wrong = fields.get_values<double>();
  trial.strangers = fields.get_values<double>();
  return trial;
}

std::string pack_trials(const EvaluationData& data, const Settings& settings, bool measure_confidence) {
  Packer packer;
  packer.add(settings_to_json(settings).dump()).add(measure_confidence).add(data.tested.has_value());
  pack_tested(packer, data.strangers);
  if (data.tested) {
    pack_tested(packer, *data.tested);
  }
  return packer.take();
}

Work trial_work(const EvaluationData& data, const SharedGram& gram, const Settings& settings, bool measure_confidence) {
  return [&data, &gram, settings, measure_confidence](std::string_view bytes) {
    Unpacker fields(bytes);
    Split split;
    split.train = fields.get_values<std::uint32_t>();
    split.test = fields.get_values<std::uint32_t>();
    Teacher teacher(data.table, gram, settings.judge, 1);
    return pack(run_trial(data, teacher, split, settings, measure_confidence));
  };
}

Work make_trial_work(std::string_view context, KeptData& kept) {
  Unpacker fields(context);
  const Settings settings = settings_from_json(nlohmann::json::parse(fields.get_text()));
  const bool measure_confidence = fields.get<bool>();
  const bool tested = fields.get<bool>();
  kept.data.strangers = unpack_tested(fields);
  kept.data.tested = tested ? std::optional(unpack_tested(fields)) : std::nullopt;
  return trial_work(kept.data, kept.gram, settings, measure_confidence);
}

}  // namespace spincat
