#include "spincat/camera/calibration.h"

#include <fmt/format.h>

#include <charconv>
#include <map>
#include <string>

#include "spincat/error.h"
#include "spincat/io/file.h"

namespace spincat {
namespace {

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kSpace = " \t\r";
  const std::size_t first = text.find_first_not_of(kSpace);
  return first == std::string_view::npos ? std::string_view{}
                                         : text.substr(first, text.find_last_not_of(kSpace) - first + 1);
}

// The numbers of the text by their names.
std::map<std::string, double, std::less<>> numbers_of(std::string_view text) {
  std::map<std::string, double, std::less<>> numbers;
  int line_number = 0;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = trimmed(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    ++line_number;
    if (line.empty() || line.front() == '#') {
      continue;
    }
    const std::size_t space = std::min(line.find_first_of(" \t"), line.size());
    const std::string_view value = trimmed(line.substr(space));
    double number = 0.0;
    const auto [rest, error] = std::from_chars(value.data(), value.data() + value.size(), number);
    if (error != std::errc{} || rest != value.data() + value.size()) {
      throw InputError(fmt::format("line {}: expected a name and a number, as in \"fx 525\"", line_number));
    }
    numbers[std::string(line.substr(0, space))] = number;
  }
  return numbers;
}

std::optional<int> pixels(std::string_view name, double value) {
  if (!(value >= 1.0 && value <= 8'192.0)) {
    throw InputError(fmt::format("{} {} is out of range (1 to 8192 pixels)", name, value));
  }
  return static_cast<int>(value);
}

}  // namespace

CameraCalibration parse_calibration(std::string_view text) {
  CameraCalibration result;
  std::map<std::string, double, std::less<>> numbers = numbers_of(text);
  for (const auto& [name, to] : {std::pair{"fx", &result.intrinsics.fx},
                                 {"fy", &result.intrinsics.fy},
                                 {"cx", &result.intrinsics.cx},
                                 {"cy", &result.intrinsics.cy}}) {
    const auto found = numbers.find(name);
    if (found == numbers.end()) {
      throw InputError(fmt::format("does not give {}", name));
    }
    *to = found->second;
    numbers.erase(found);
  }
  for (const auto& [name, value] : numbers) {
    if (name == "units_per_metre") {
      result.units_per_metre = value;
    } else if (name == "width") {
      result.width = pixels(name, value);
    } else if (name == "height") {
      result.height = pixels(name, value);
    } else {
      throw InputError(fmt::format("'{}' is not known (one of fx, fy, cx, cy, units_per_metre, width, height)", name));
    }
  }
  if (!(result.units_per_metre >= 1e-3 && result.units_per_metre <= 1e9)) {
    throw InputError(fmt::format("units_per_metre {} is out of range (0.001 to 1000000000)", result.units_per_metre));
  }
  result.intrinsics.validate();
  return result;
}

CameraCalibration read_calibration(const std::filesystem::path& file) {
  try {
    return parse_calibration(read_file(file));
  } catch (const InputError& error) {
    throw error.file().empty() ? InputError(file.string(), error.problem()) : error;
  }
}

std::string calibration_text(const CameraCalibration& calibration) {
  const Intrinsics& k = calibration.intrinsics;
  std::string text = fmt::format("fx {}\nfy {}\ncx {}\ncy {}\nunits_per_metre {}\n", k.fx, k.fy, k.cx, k.cy,
                                 calibration.units_per_metre);
  if (calibration.width) {
    text += fmt::format("width {}\n", *calibration.width);
  }
  if (calibration.height) {
    text += fmt::format("height {}\n", *calibration.height);
  }
  return text;
}

}  // namespace spincat
