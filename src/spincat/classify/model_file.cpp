#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "spincat/classify/model_data.h"
#include "spincat/encode/encoding.h"
#include "spincat/error.h"
#include "spincat/files/file.h"
#include "spincat/files/magic.h"
#include "spincat/files/paths.h"
#include "spincat/files/record_file.h"
#include "spincat/settings/settings_json.h"
#include "spincat/settings/whole_number.h"

// Numbers are kept as the machine has them; spincat is built for little-endian machines only.
static_assert(std::endian::native == std::endian::little);

namespace spincat {
namespace {

using Json = nlohmann::json;

constexpr std::size_t kMostCategories = 10'000;
constexpr std::size_t kMostFeatures = 100'000'000;
// Products and sums of numbers up to this stay finite, and with them margins and confidences.
constexpr double kLargestNumber = 1e30;

const Json& member(const Json& json, const char* name) {
  const auto at = json.find(name);
  if (at == json.end()) {
    throw InputError(fmt::format("model: '{}' is missing", name));
  }
  return *at;
}

// `count` finite floats into `values`.
void unpack_floats(const Json& json, const char* name, std::span<float> values) {
  const Json& blob = member(json, name);
  if (!blob.is_binary() || blob.get_binary().size() != values.size_bytes()) {
    throw InputError(fmt::format("model: '{}' does not hold {} numbers", name, values.size()));
  }
  if (!values.empty()) {
    std::memcpy(values.data(), blob.get_binary().data(), values.size_bytes());
  }
  for (const float value : values) {
    if (!std::isfinite(value)) {
      throw InputError(fmt::format("model: '{}' holds a number that is not finite", name));
    }
    if (std::abs(value) > kLargestNumber) {
      throw InputError(fmt::format("model: '{}' holds {}, which no training gives", name, value));
    }
  }
}

template <class T>
T value(const Json& json, const char* name) {
  try {
    return member(json, name).get<T>();
  } catch (const Json::exception&) {
    throw InputError(fmt::format("model: '{}' is of the wrong type", name));
  }
}

// A count for each judge or category.
std::vector<std::uint32_t> counts(const Json& json, const char* name, std::size_t size) {
  const Json& list = member(json, name);
  std::vector<std::uint32_t> result;
  if (list.is_array() && list.size() == size) {
    for (const Json& element : list) {
      if (const auto count = whole_number<std::uint32_t>(element)) {
        result.push_back(*count);
      }
    }
  }
  if (result.size() != size) {
    throw InputError(fmt::format("model: '{}' does not hold {} counts", name, size));
  }
  return result;
}

template <class Matrix>
std::span<const float> numbers_of(const Matrix& matrix) {
  return {matrix.data(), static_cast<std::size_t>(matrix.size())};
}

Json judges_to_json(const JudgeList& judges, RecordBlobs& blobs) {
  Json json = {{"features", judges.seen_length()},
               {"weights", blobs.add(numbers_of(judges.weights))},
               {"bias", blobs.add(numbers_of(judges.bias))},
               {"support_vectors", judges.support_vectors}};
  if (judges.kernel.kind != KernelKind::linear) {
    json["blocks"] = judges.kernel.block_sizes;
    json["scale"] = blobs.add(judges.kernel.scale);
    json["supports"] = blobs.add(numbers_of(judges.supports));
  }
  if (!judges.whitening.empty()) {
    json["inputs"] = judges.whitening.input_length();
    json["map"] = blobs.add(std::as_bytes(judges.whitening.columns.bits()));
    json["middle"] = blobs.add(numbers_of(judges.whitening.middle));
  }
  if (!judges.codebook.empty()) {
    json["local_size"] = judges.codebook.words.cols();
    json["codebook"] = blobs.add(numbers_of(judges.codebook.words));
  }
  return json;
}

// A matrix of `columns` columns and as many rows as the blob has, all numbers finite. The blob's size is checked before
// any memory is taken for it.
FeatureMatrix unpack_matrix(const Json& json, const char* name, std::size_t columns) {
  const Json& blob = member(json, name);
  const std::size_t numbers = blob.is_binary() ? blob.get_binary().size() / sizeof(float) : 0;
  if (numbers == 0 || numbers % columns != 0) {
    throw InputError(fmt::format("model: '{}' is of the wrong size", name));
  }
  FeatureMatrix matrix(static_cast<Eigen::Index>(numbers / columns), static_cast<Eigen::Index>(columns));
  unpack_floats(json, name, {matrix.data(), numbers});
  return matrix;
}

// What judges with another kernel than the linear one need besides.
void kernel_from_json(const Json& json, KernelKind kind, std::size_t features, JudgeList& judges) {
  judges.kernel.kind = kind;
  const Json& list = member(json, "blocks");
  if (!list.is_array() || list.empty() || list.size() > features) {
    throw InputError("model: 'blocks' is not a list of counts");
  }
  judges.kernel.block_sizes = counts(json, "blocks", list.size());
  std::size_t sum = 0;
  for (const std::uint32_t size : judges.kernel.block_sizes) {
    sum += size;
    if (size == 0) {
      throw InputError("model: 'blocks' has an empty block");
    }
  }
  if (sum != features) {
    throw InputError(fmt::format("model: 'blocks' add up to {}, not to {} features", sum, features));
  }
  judges.kernel.scale.resize(list.size());
  unpack_floats(json, "scale", judges.kernel.scale);
  for (const float scale : judges.kernel.scale) {
    if (scale < 0.0F) {
      throw InputError("model: 'scale' holds a number below 0");
    }
  }
  judges.supports = unpack_matrix(json, "supports", features);
}

// A space of `dimensions` numbers.
Whitening whitening_from_json(const Json& json, std::size_t dimensions) {
  const std::size_t inputs = whole_number<std::size_t>(member(json, "inputs")).value_or(0);
  const Json& blob = member(json, "map");
  if (inputs == 0 || inputs > kMostFeatures || !blob.is_binary() ||
      blob.get_binary().size() != dimensions * inputs * sizeof(std::uint16_t)) {
    throw InputError("model: 'map' is of the wrong size");
  }
  std::vector<std::uint16_t> halves(dimensions * inputs);
  std::memcpy(halves.data(), blob.get_binary().data(), blob.get_binary().size());
  Whitening whitening;
  whitening.columns = HalfRows(inputs, std::move(halves));
  if (!whitening.columns.all_finite()) {
    throw InputError("model: 'map' holds a number that is not finite");
  }
  whitening.middle.resize(static_cast<Eigen::Index>(dimensions));
  unpack_floats(json, "middle", {whitening.middle.data(), dimensions});
  return whitening;
}

void codebook_from_json(const Json& json, std::size_t features, Codebook& codebook) {
  const std::size_t size = whole_number<std::size_t>(member(json, "local_size")).value_or(0);
  if (size == 0 || size > kMostFeatures / kLocalFeatures) {
    throw InputError(
        fmt::format("model: 'local_size' is not a whole number from 1 to {}", kMostFeatures / kLocalFeatures));
  }
  codebook.words = unpack_matrix(json, "codebook", size);
  if (static_cast<std::size_t>(codebook.words.rows()) != features) {
    throw InputError("model: 'codebook' is of the wrong size");
  }
}

JudgeList judges_from_json(const Json& json, std::size_t categories, KernelKind kind) {
  const std::size_t count = categories * (categories - 1) / 2;
  const std::size_t features = whole_number<std::size_t>(member(json, "features")).value_or(0);
  if (features == 0 || features > kMostFeatures) {
    throw InputError(fmt::format("model: 'features' is not a whole number from 1 to {}", kMostFeatures));
  }
  JudgeList judges;
  judges.categories = static_cast<std::uint32_t>(categories);
  std::size_t columns = features;
  if (kind != KernelKind::linear) {
    kernel_from_json(json, kind, features, judges);
    columns = static_cast<std::size_t>(judges.supports.rows());
  }
  judges.weights = unpack_matrix(json, "weights", columns);
  if (static_cast<std::size_t>(judges.weights.rows()) != count) {
    throw InputError("model: 'weights' is of the wrong size");
  }
  if (json.contains("map")) {
    judges.whitening = whitening_from_json(json, features);
  }
  if (json.contains("codebook")) {
    codebook_from_json(json, features, judges.codebook);
  }
  judges.bias.resize(static_cast<Eigen::Index>(count));
  unpack_floats(json, "bias", {judges.bias.data(), count});
  judges.support_vectors = counts(json, "support_vectors", count);
  return judges;
}

Json scaling_to_json(const PlattScaling& scaling) {
  return {{"slope", scaling.slope}, {"offset", scaling.offset}};
}

PlattScaling scaling_from_json(const Json& json, const char* name) {
  const PlattScaling scaling{value<double>(member(json, name), "slope"), value<double>(member(json, name), "offset")};
  for (const double number : {scaling.slope, scaling.offset}) {
    if (!(std::abs(number) <= kLargestNumber)) {
      throw InputError(fmt::format("model: '{}' is not finite, or too large", name));
    }
  }
  return scaling;
}

Json known_to_json(const KnownJudge& known, RecordBlobs& blobs) {
  return {{"weights", blobs.add(numbers_of(known.weights))},
          {"bias", known.bias},
          {"scaling", scaling_to_json(known.scaling)},
          {"least", known.least}};
}

KnownJudge known_from_json(const Json& json, std::size_t features) {
  KnownJudge known;
  known.weights.resize(static_cast<Eigen::Index>(features));
  unpack_floats(json, "weights", {known.weights.data(), features});
  known.bias = value<float>(json, "bias");
  known.scaling = scaling_from_json(json, "scaling");
  known.least = value<double>(json, "least");
  if (!(std::abs(known.bias) <= kLargestNumber) || !(known.least >= 0.0 && known.least <= 1.0)) {
    throw InputError("model: 'known' holds a number out of range");
  }
  return known;
}

ModelData model_from_json(const Json& json) {
  ModelData model;
  model.settings = settings_from_json(member(json, "settings"));
  model.settings.validate_for_judges();
  model.categories = value<std::vector<std::string>>(json, "categories");
  const std::size_t n = model.categories.size();
  if (n < 2 || n > kMostCategories || std::set(model.categories.begin(), model.categories.end()).size() != n) {
    throw InputError("model: 'categories' are not two or more different names");
  }
  if (std::ranges::find(model.categories, std::string()) != model.categories.end()) {
    throw InputError("model: a category has an empty name");
  }
  model.judges = judges_from_json(member(json, "judges"), n, model.settings.judge.kernel);
  if (make_encoding(model.settings.encoding)->gives_local_features() == model.judges.codebook.empty()) {
    throw InputError(fmt::format("model: a codebook is {} for the encoding {}",
                                 model.judges.codebook.empty() ? "missing" : "not expected", model.settings.encoding));
  }
  if ((model.settings.judge.dimensions > 0) == model.judges.whitening.empty()) {
    throw InputError(fmt::format("model: a space that judges learn in is {}",
                                 model.judges.whitening.empty() ? "missing" : "not expected"));
  }
  model.calibration = scaling_from_json(json, "calibration");
  if (json.contains("known")) {
    model.known = known_from_json(member(json, "known"), model.judges.seen_length());
  }
  model.dataset = value<std::string>(json, "dataset");
  model.made_by = value<std::string>(json, "made_by");
  model.object_counts = counts(json, "object_counts", n);
  const std::vector<std::uint32_t> kinds = counts(json, "kinds", 2);
  model.kinds = {kinds[0], kinds[1]};
  return model;
}

}  // namespace

void write_model(const std::filesystem::path& file, const Model& written) {
  const ModelData& model = written.data();
  RecordBlobs blobs;
  Json json = {{"settings", settings_to_json(model.settings)},
               {"categories", model.categories},
               {"judges", judges_to_json(model.judges, blobs)},
               {"calibration", scaling_to_json(model.calibration)},
               {"dataset", model.dataset},
               {"object_counts", model.object_counts},
               {"kinds", {model.kinds.meshes, model.kinds.clouds}},
               {"made_by", model.made_by}};
  if (!model.known.empty()) {
    json["known"] = known_to_json(model.known, blobs);
  }
  write_record(file, "model", kModelVersion, json, blobs);
}

Model read_model(const std::filesystem::path& file) {
  const std::string bytes = read_file(file);
  ModelData model = naming_file(
      file, [&] { return model_from_json(unpack_record(bytes, "model", kModelVersion, kOldestModelVersion)); });
  model.file = file;
  return Model(std::move(model));
}

bool is_model_file(const std::filesystem::path& file) {
  std::array<char, 8> first{};
  std::ifstream stream(file, std::ios::binary);
  stream.read(first.data(), first.size());
  return stream && std::string_view(first.data(), first.size()) == kFileMagic;
}

}  // namespace spincat
