#include "spincat/classify/classify.h"

#include <fmt/format.h>

#include <vector>

#include "spincat/classify/model_data.h"
#include "spincat/describe/stopwatch.h"
#include "spincat/describe/training_copies.h"
#include "spincat/error.h"
#include "spincat/files/paths.h"
#include "spincat/io/read_object.h"

namespace spincat {

Classification classify(const Model& by, const Object& object, const EncodePrepared& encoder) {
  const ModelData& model = by.data();
  Classification result;
  result.kind_mismatch = kind_mismatch(kind_of(object), model.kinds, model.settings.trained_for);
  const std::optional<Object> shown = shown_instead(object, model.settings);
  const FeatureVector features =
      describe(shown ? *shown : object, model.settings, points_seed(model.settings), &result.seconds, encoder);
  if (features.values.size() != model.feature_length()) {
    throw InputError(
        fmt::format("gives {} features where the model expects {}", features.values.size(), model.feature_length()));
  }
  Stopwatch watch;
  const std::vector<float> seen = model.judges.seen(features.values);
  result.ballot = model.judges.vote_on(seen);
  result.confidence = model.calibration.probability(static_cast<double>(result.ballot.weakest_margin));
  result.known = model.known.known(seen);
  result.seconds.judge = watch.lap();
  return result;
}

Classification classify_file(const Model& model, const std::filesystem::path& file, const ReadLimits& limits,
                             const EncodePrepared& encoder) {
  Stopwatch watch;
  const Object object = read_object(file, limits);
  const double read = watch.lap();
  Classification result = naming_file(file, [&] { return classify(model, object, encoder); });
  result.seconds.read = read;
  return result;
}

}  // namespace spincat
