#include "spincat/settings/settings_json.h"

#include <fmt/format.h>

#include <optional>
#include <string>

#include "spincat/error.h"
#include "spincat/settings/setting_names.h"
#include "spincat/settings/whole_number.h"

namespace spincat {
namespace {

using Json = nlohmann::json;

const Json& member(const Json& json, const char* name) {
  const auto at = json.find(name);
  if (at == json.end()) {
    throw InputError(fmt::format("setting '{}' is missing", name));
  }
  return *at;
}

template <class T>
T field(const Json& json, const char* name) {
  const Json& value = member(json, name);
  try {
    return value.get<T>();
  } catch (const Json::exception&) {
    throw InputError(fmt::format("setting '{}' is of the wrong type", name));
  }
}

std::string text(const Json& json, const char* name) {
  auto value = field<std::string>(json, name);
  if (!is_setting_text(value)) {
    throw InputError(fmt::format("setting '{}' is too long or not printable", name));
  }
  return value;
}

// A whole number: a fraction, or a number beyond the type, is not quietly cut.
template <class T>
T whole(const Json& json, const char* name) {
  const std::optional<T> number = whole_number<T>(member(json, name));
  if (!number) {
    throw InputError(fmt::format("setting '{}' is not a whole number in range", name));
  }
  return *number;
}

template <class Choice>
Choice choice(const Json& json, const char* name) {
  return choice_of<Choice>(name, text(json, name));
}

}  // namespace

nlohmann::ordered_json settings_to_json(const Settings& s) {
  return {{"preset", s.preset},
          {"surface", name_of(s.prepare.surface)},
          {"orientation", name_of(s.prepare.orientation)},
          {"points", s.prepare.points},
          {"spin_points", s.prepare.spin_points},
          {"neighbours", s.prepare.neighbours},
          {"convention", name_of(s.spin.convention)},
          {"image_width", s.spin.image_width},
          {"bin_size", s.spin.bin_size},
          {"bin_size_unit", name_of(s.bin_size_unit)},
          {"support_angle", s.spin.support_angle},
          {"binning", name_of(s.spin.binning)},
          {"angle_test", name_of(s.spin.angle_test)},
          {"encoding", s.encoding},
          {"plain_samples", s.plain_samples},
          {"up", name_of(s.up)},
          {"draws", s.draws},
          {"words", s.words},
          {"kernel", name_of(s.judge.kernel)},
          {"c", s.judge.c},
          {"class_weights", s.judge.class_weights},
          {"copies", s.copies},
          {"trained_for", name_of(s.trained_for)},
          {"views", s.views},
          {"stretch", s.stretch},
          {"seed", s.seed}};
}

Settings settings_from_json(const Json& json) {
  Settings s;
  s.preset = text(json, "preset");
  s.prepare.surface = choice<SurfaceKind>(json, "surface");
  s.prepare.orientation = choice<NormalOrientation>(json, "orientation");
  s.prepare.points = whole<int>(json, "points");
  s.prepare.spin_points = whole<int>(json, "spin_points");
  s.prepare.neighbours = whole<int>(json, "neighbours");
  s.spin.convention = choice<SpinConvention>(json, "convention");
  s.spin.image_width = whole<int>(json, "image_width");
  s.spin.bin_size = field<double>(json, "bin_size");
  s.bin_size_unit = choice<BinSizeUnit>(json, "bin_size_unit");
  s.spin.support_angle = field<double>(json, "support_angle");
  s.spin.binning = choice<Binning>(json, "binning");
  s.spin.angle_test = choice<AngleTest>(json, "angle_test");
  s.encoding = text(json, "encoding");
  s.plain_samples = field<bool>(json, "plain_samples");
  s.up = choice<UpAxis>(json, "up");
  s.draws = whole<int>(json, "draws");
  s.words = whole<int>(json, "words");
  s.judge.kernel = choice<KernelKind>(json, "kernel");
  s.judge.c = field<double>(json, "c");
  s.judge.class_weights = field<bool>(json, "class_weights");
  s.copies = whole<int>(json, "copies");
  s.trained_for =
      choice<TrainedFor>(json, json.contains("trained_for") ? "trained_for" : "taught_for");  // as 0.1 wrote it
  s.views = whole<int>(json, "views");
  s.stretch = field<double>(json, "stretch");
  s.seed = whole<std::uint64_t>(json, "seed");
  s.validate();
  return s;
}

}  // namespace spincat
