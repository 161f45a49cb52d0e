// A sweep as a table for people, and as JSON and CSV for programs.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "spincat/evaluate/sweep.h"

namespace spincat {

// A line for each point: the values, the rates with their spread, the time by stage (where that is wider than `width`
// columns, of all stages together).
std::string sweep_text(const Sweep& sweep, std::size_t width);

}  // namespace spincat
