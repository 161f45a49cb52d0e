// Calibrations as other programs write them.
#pragma once

#include <string_view>

#include "spincat/camera/source/calibration.h"

namespace spincat {

// Whether the text is one of them, and not lines "fx 525".
bool is_foreign_calibration(std::string_view text);

// Reads JSON, YAML or lines "name = value" with fx, fy and cx, cy (or ppx, ppy), or with a camera matrix of 3 x 3, 3 x
// 4 or 4 x 4 numbers, row by row or column by column, in lists of lists or in one; or nothing but such a matrix, or "fx
// fy cx cy". Of several cameras those of which a group's name says "depth"; what is left must agree. Throws InputError
// (without a file name).
CameraCalibration parse_foreign_calibration(std::string_view text);

}  // namespace spincat
