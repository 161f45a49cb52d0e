#include "spincat/camera/source/calibration.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <string>

#include "spincat/camera/source/calibration_formats.h"
#include "spincat/error.h"
#include "spincat/files/file.h"
#include "spincat/files/paths.h"
#include "spincat/io/text_cursor.h"

namespace spincat {
namespace {

// The numbers of the text by their names.
std::map<std::string, double, std::less<>> numbers_of(std::string_view text) {
  static constexpr std::array<std::string_view, 7> kNames = {"fx",    "fy",    "cx", "cy", "units_per_metre",
                                                             "width", "height"};
  std::map<std::string, double, std::less<>> numbers;
  io::TextCursor words(text);
  while (words.word_follows()) {
    const std::string_view name = words.word();
    if (std::ranges::find(kNames, name) == kNames.end()) {
      words.fail(fmt::format("{} is not known (one of {})", io::in_quotes(name), fmt::join(kNames, ", ")));
    }
    numbers[std::string(name)] = words.finite_number("a number behind the name, as in \"fx 525\"");
    if (words.word_on_line()) {
      words.fail("expected the end of the line, found " + io::in_quotes(words.word()));
    }
  }
  return numbers;
}

// Of lines "fx 525".
CameraCalibration parse_own_calibration(std::string_view text) {
  CameraCalibration result;
  const auto numbers = numbers_of(text);
  for (const auto& [name, to] : {std::pair{"fx", &result.intrinsics.fx},
                                 {"fy", &result.intrinsics.fy},
                                 {"cx", &result.intrinsics.cx},
                                 {"cy", &result.intrinsics.cy}}) {
    const auto found = numbers.find(name);
    if (found == numbers.end()) {
      throw InputError(fmt::format("does not give {}", name));
    }
    *to = found->second;
  }
  for (const auto& [name, value] : numbers) {
    if (name == "units_per_metre") {
      result.units_per_metre = value;
    } else if (name == "width") {
      result.width = checked_pixels(name, value);
    } else if (name == "height") {
      result.height = checked_pixels(name, value);
    }
  }
  return result;
}

}  // namespace

int checked_pixels(std::string_view name, double value) {
  if (!(value >= 1.0 && value <= 8'192.0)) {
    throw InputError(fmt::format("{} {} is out of range (1 to 8192 pixels)", name, value));
  }
  return static_cast<int>(value);
}

CameraCalibration parse_calibration(std::string_view text) {
  const CameraCalibration result =
      is_foreign_calibration(text) ? parse_foreign_calibration(text) : parse_own_calibration(text);
  const double units = result.units_per_metre.value_or(kUsualUnits);
  if (!(units >= 1e-3 && units <= 1e9)) {
    throw InputError(fmt::format("units_per_metre {} is out of range (0.001 to 1000000000)", units));
  }
  result.intrinsics.validate();
  return result;
}

CameraCalibration read_calibration(const std::filesystem::path& file) {
  return naming_file(file, [&] { return parse_calibration(read_file(file)); });
}

std::string calibration_text(const CameraCalibration& calibration) {
  const Intrinsics& k = calibration.intrinsics;
  std::string text = fmt::format("fx {}\nfy {}\ncx {}\ncy {}\n", k.fx, k.fy, k.cx, k.cy);
  if (calibration.units_per_metre) {
    text += fmt::format("units_per_metre {}\n", *calibration.units_per_metre);
  }
  if (calibration.width) {
    text += fmt::format("width {}\n", *calibration.width);
  }
  if (calibration.height) {
    text += fmt::format("height {}\n", *calibration.height);
  }
  return text;
}

}  // namespace spincat
