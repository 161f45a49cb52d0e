#include "spincat/pipeline/trial.h"

#include "spincat/pipeline/teach.h"

namespace spincat {

Trial run_trial(const EvaluationData& data, const SharedGram& gram, const Split& split, const Settings& settings,
                bool measure_confidence, int threads) {
  const FeatureTable& table = data.table;
  const std::size_t n = table.categories.size();
  const JudgeList judges = teach_judges(table, gram, split.train, settings.judge, threads, Progress{});
  Calibration calibration;
  Familiarity familiarity;
  if (measure_confidence) {
    familiarity = familiarity_of(table, split.train);
    calibration = calibrate(table, gram, split.train, settings.judge, settings.seed, threads, Progress{});
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

}  // namespace spincat
