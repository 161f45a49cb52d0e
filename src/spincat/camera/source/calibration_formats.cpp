#include "spincat/camera/source/calibration_formats.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "spincat/camera/source/name_tree.h"
#include "spincat/error.h"
#include "spincat/io/text_cursor.h"

namespace spincat {
namespace {

enum class Meaning { fx, fy, cx, cy, focal, centre, matrix, projection, data, width, height, size, units, scale };

// In lower case, with the programs that call them so.
constexpr std::pair<std::string_view, Meaning> kNames[] = {{"fx", Meaning::fx},
                                                           {"fy", Meaning::fy},
                                                           {"cx", Meaning::cx},
                                                           {"cy", Meaning::cy},
                                                           {"ppx", Meaning::cx},  // RealSense
                                                           {"ppy", Meaning::cy},
                                                           {"fl_x", Meaning::fx},  // nerfstudio
                                                           {"fl_y", Meaning::fy},
                                                           {"f_x", Meaning::fx},
                                                           {"f_y", Meaning::fy},
                                                           {"c_x", Meaning::cx},
                                                           {"c_y", Meaning::cy},
                                                           {"focal_length", Meaning::focal},
                                                           {"principal_point", Meaning::centre},
                                                           {"intrinsic_matrix", Meaning::matrix},  // Open3D
                                                           {"camera_matrix", Meaning::matrix},     // ROS, OpenCV
                                                           {"cameramatrix", Meaning::matrix},
                                                           {"k", Meaning::matrix},      // ROS
                                                           {"cam_k", Meaning::matrix},  // BOP
                                                           {"intrinsic", Meaning::matrix},
                                                           {"intrinsics", Meaning::matrix},  // Kalibr: fx fy cx cy
                                                           {"camera_intrinsics", Meaning::matrix},
                                                           {"p", Meaning::projection},  // ROS
                                                           {"projection_matrix", Meaning::projection},
                                                           {"data", Meaning::data},  // of a matrix
                                                           {"width", Meaning::width},
                                                           {"image_width", Meaning::width},
                                                           {"w", Meaning::width},
                                                           {"height", Meaning::height},
                                                           {"image_height", Meaning::height},
                                                           {"h", Meaning::height},
                                                           {"resolution", Meaning::size},  // Kalibr
                                                           {"image_size", Meaning::size},
                                                           {"units_per_metre", Meaning::units},
                                                           {"depth_scale", Meaning::scale},  // RealSense, Open3D, BOP
                                                           {"depth_units", Meaning::scale},
                                                           {"depthmapfactor", Meaning::scale},  // ORB-SLAM
                                                           {"png_depth_scale", Meaning::scale}};

std::optional<Meaning> meaning_of(std::string_view name) {
  const auto* const found = std::ranges::find(kNames, name, &std::pair<std::string_view, Meaning>::first);
  return found != std::end(kNames) ? std::optional(found->second) : std::nullopt;
}

bool has_meaning(std::string_view name) {
  return meaning_of(name).has_value();
}

// "fx fy cx cy", or a camera matrix, whichever way its numbers are ordered.
std::optional<Intrinsics> intrinsics_in(const std::vector<double>& m) {
  if (m.size() == 4) {
    return Intrinsics{m[0], m[1], m[2], m[3]};
  }
  const std::size_t columns = m.size() == 9 ? 3 : 4;
  const std::size_t rows = m.size() == 16 ? 4 : 3;
  if (m.size() != rows * columns) {
    return {};
  }
  constexpr double kRounding = 1e-6;
  for (const bool by_columns : {false, true}) {
    const auto at = [&](std::size_t row, std::size_t column) {
      return by_columns ? m[column * rows + row] : m[row * columns + column];
    };
    const auto is = [&](std::size_t row, std::size_t column, double value) {
      return std::abs(at(row, column) - value) <= kRounding;
    };
    if (is(1, 0, 0.0) && is(2, 0, 0.0) && is(2, 1, 0.0) && is(2, 2, 1.0)) {
      return Intrinsics{at(0, 0), at(1, 1), at(0, 2), at(1, 2)};
    }
  }
  return {};
}

constexpr std::string_view kExpected =
    "expected fx fy cx cy, or a matrix of 3 x 3, 3 x 4 or 4 x 4 with fx 0 cx, 0 fy cy, 0 0 1";

// Numbers without any names.
CameraCalibration bare_calibration(std::string_view text) {
  std::string plain(text);
  std::ranges::replace_if(
      plain, [](char c) { return std::string_view("[](),;").find(c) != std::string_view::npos; }, ' ');
  io::TextCursor words(plain);
  std::vector<double> numbers;
  while (words.word_follows() && numbers.size() <= 16) {
    numbers.push_back(words.finite_number("a number"));
  }
  const std::optional<Intrinsics> intrinsics = intrinsics_in(numbers);
  if (!intrinsics) {
    throw InputError(fmt::format("holds {} numbers: {}",
                                 numbers.size() > 16 ? "more than 16" : fmt::to_string(numbers.size()), kExpected));
  }
  CameraCalibration result;
  result.intrinsics = *intrinsics;
  return result;
}

// What a text with names says of its cameras.
class NamedCalibration {
 public:
  explicit NamedCalibration(std::string_view text) : tree_(read_name_tree(text, has_meaning)) {
    for (const NameTree::Entry& entry : tree_.entries) {
      add(entry);
    }
  }

  CameraCalibration read() const;

 private:
  using Entry = NameTree::Entry;
  using Meanings = std::map<Meaning, const Entry*>;

  void add(const Entry& entry);
  std::optional<Intrinsics> camera_of(const Meanings& group) const;
  std::size_t chosen_group() const;
  bool is_of_depth(std::size_t group) const;
  std::optional<double> one_number(const Meanings& group, Meaning meaning, std::size_t place = 0) const;
  std::optional<double> nearest(std::size_t group, Meaning meaning, std::size_t place = 0) const;
  std::optional<double> units_for(std::size_t group) const;

  NameTree tree_;
  std::map<std::size_t, Meanings> groups_;
};

void NamedCalibration::add(const Entry& entry) {
  std::size_t group = entry.group;
  Meaning meaning = *meaning_of(entry.name);
  if (meaning == Meaning::data) {  // the name of the matrix stands outside
    const std::optional<Meaning> outer = meaning_of(tree_.groups[group].name);
    if (outer != Meaning::matrix && outer != Meaning::projection) {
      return;
    }
    meaning = *outer;
    group = tree_.groups[group].parent;
  } else if (entry.numbers.empty() && meaning != Meaning::fx && meaning != Meaning::fy && meaning != Meaning::cx &&
             meaning != Meaning::cy) {
    return;  // it may be the name of a group
  }
  const auto [place, is_new] = groups_[group].try_emplace(meaning, &entry);
  if (!is_new && place->second->numbers != entry.numbers) {
    throw InputError(fmt::format("line {}: gives another {} than line {}", entry.line, io::in_quotes(entry.name),
                                 place->second->line));
  }
}

std::optional<double> NamedCalibration::one_number(const Meanings& group, Meaning meaning, std::size_t place) const {
  const auto found = group.find(meaning);
  if (found == group.end()) {
    return {};
  }
  const Entry& entry = *found->second;
  if (entry.numbers.size() <= place) {
    throw InputError(fmt::format("line {}: expected a number behind {}", entry.line, io::in_quotes(entry.name)));
  }
  return entry.numbers[place];
}

// Of the group, or of one that it belongs to.
std::optional<double> NamedCalibration::nearest(std::size_t group, Meaning meaning, std::size_t place) const {
  while (true) {
    const auto found = groups_.find(group);
    if (found != groups_.end()) {
      if (const std::optional<double> number = one_number(found->second, meaning, place)) {
        return number;
      }
    }
    if (group == 0) {
      return {};
    }
    group = tree_.groups[group].parent;
  }
}

std::optional<Intrinsics> NamedCalibration::camera_of(const Meanings& group) const {
  const auto either = [&](Meaning one, Meaning both, std::size_t place) {
    const std::optional<double> number = one_number(group, one);
    return number ? number : one_number(group, both, place);
  };
  const auto focal = group.find(Meaning::focal);
  const std::size_t second = focal != group.end() && focal->second->numbers.size() == 1 ? 0 : 1;
  const std::optional<double> fx = either(Meaning::fx, Meaning::focal, 0);
  const std::optional<double> fy = either(Meaning::fy, Meaning::focal, second);
  const std::optional<double> cx = either(Meaning::cx, Meaning::centre, 0);
  const std::optional<double> cy = either(Meaning::cy, Meaning::centre, 1);
  if (fx && fy && cx && cy) {
    return Intrinsics{*fx, *fy, *cx, *cy};
  }
  for (const Meaning meaning : {Meaning::matrix, Meaning::projection}) {
    if (const auto found = group.find(meaning); found != group.end()) {
      const Entry& entry = *found->second;
      const std::optional<Intrinsics> intrinsics = intrinsics_in(entry.numbers);
      if (!intrinsics) {
        throw InputError(
            fmt::format("line {}: {} is no camera matrix: {}", entry.line, io::in_quotes(entry.name), kExpected));
      }
      return intrinsics;
    }
  }
  return {};
}

bool NamedCalibration::is_of_depth(std::size_t group) const {
  for (; group != 0; group = tree_.groups[group].parent) {
    if (tree_.groups[group].name.find("depth") != std::string::npos) {
      return true;
    }
  }
  return false;
}

std::size_t NamedCalibration::chosen_group() const {
  std::vector<std::pair<std::size_t, Intrinsics>> cameras;
  for (const auto& [group, meanings] : groups_) {
    if (const std::optional<Intrinsics> camera = camera_of(meanings)) {
      cameras.emplace_back(group, *camera);
    }
  }
  const auto of_depth = [&](const auto& camera) { return is_of_depth(camera.first); };
  if (std::ranges::any_of(cameras, of_depth)) {
    std::erase_if(cameras, std::not_fn(of_depth));
  }
  if (cameras.empty()) {
    throw InputError("does not give fx, fy, cx and cy, nor a camera matrix");
  }
  const auto same = [&](const auto& camera) {
    const Intrinsics& a = camera.second;
    const Intrinsics& b = cameras.front().second;
    return a.fx == b.fx && a.fy == b.fy && a.cx == b.cx && a.cy == b.cy;
  };
  if (!std::ranges::all_of(cameras, same)) {
    throw InputError(
        fmt::format("gives {} cameras that differ: leave that of the depth pictures alone in it", cameras.size()));
  }
  return cameras.front().first;
}

// RealSense says metres a unit, Open3D units a metre, BOP millimetres a unit.
std::optional<double> NamedCalibration::units_for(std::size_t group) const {
  if (const std::optional<double> units = nearest(group, Meaning::units)) {
    return units;
  }
  const std::optional<double> scale = nearest(group, Meaning::scale);
  if (!scale) {
    return {};
  }
  if (*scale > 0.0 && *scale <= 0.02) {
    return 1.0 / *scale;
  }
  if (*scale > 0.02 && *scale <= 1.0) {
    return 1'000.0 / *scale;
  }
  if (*scale >= 100.0) {
    return *scale;
  }
  throw InputError(fmt::format("depth scale {} is neither metres nor millimetres a unit nor units a metre", *scale));
}

CameraCalibration NamedCalibration::read() const {
  const std::size_t group = chosen_group();
  CameraCalibration result;
  result.intrinsics = *camera_of(groups_.at(group));
  result.units_per_metre = units_for(group);
  const auto side = [&](Meaning meaning, std::size_t place, const char* name) -> std::optional<int> {
    std::optional<double> pixels = nearest(group, meaning);
    pixels = pixels ? pixels : nearest(group, Meaning::size, place);
    return pixels ? std::optional(checked_pixels(name, *pixels)) : std::nullopt;
  };
  result.width = side(Meaning::width, 0, "width");
  result.height = side(Meaning::height, 1, "height");
  return result;
}

// Whether a line ends a name as JSON, YAML and settings do.
bool has_names(std::string_view text) {
  io::TextCursor words(text);
  for (; words.word_follows(); words.skip_line()) {
    const std::string_view line = words.rest_of_line();
    if (line.substr(0, line.find('#')).find_first_of(":={") != std::string_view::npos) {
      return true;
    }
  }
  return false;
}

}  // namespace

bool is_foreign_calibration(std::string_view text) {
  io::TextCursor words(text);
  if (!words.word_follows()) {
    return false;
  }
  const char first = words.peek().front();
  if (std::string_view("0123456789.+-[({%").find(first) != std::string_view::npos) {
    return true;
  }
  return has_names(text);
}

CameraCalibration parse_foreign_calibration(std::string_view text) {
  return has_names(text) ? NamedCalibration(text).read() : bare_calibration(text);
}

}  // namespace spincat
