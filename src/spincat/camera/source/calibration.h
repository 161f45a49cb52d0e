// What a recording says about its camera.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "spincat/camera/source/frame_source.h"

namespace spincat {

struct CameraCalibration {
  Intrinsics intrinsics;
  std::optional<double> units_per_metre;  // of the numbers in depth pictures, where it is said
  std::optional<int> width;               // of the frames, in pixels, where it is said
  std::optional<int> height;
};

// Numbers in depth pictures that make a metre where nothing says it: millimetres.
inline constexpr double kUsualUnits = 1'000.0;

// Reads a text of lines "fx 525", "fy 525", "cx 319.5", "cy 239.5" and maybe "units_per_metre 1000", "width 640" and
// "height 480", in any order; empty lines and those that begin with # say nothing. fx, fy, cx and cy must be there. Or
// what other programs write: see parse_foreign_calibration. Throws InputError (without a file name) that names the
// line.
CameraCalibration parse_calibration(std::string_view text);

// The same from a file; what is thrown names it.
CameraCalibration read_calibration(const std::filesystem::path& file);

// As a number of pixels along a side. Throws InputError when it is none.
int checked_pixels(std::string_view name, double value);

// The text that parse_calibration reads.
std::string calibration_text(const CameraCalibration& calibration);

}  // namespace spincat
