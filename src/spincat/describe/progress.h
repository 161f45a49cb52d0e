// Telling how far the work is.
#pragma once

#include <cstddef>
#include <functional>
#include <string_view>

namespace spincat {

// Called now and then with what is being done ("describing objects"), how many units are done and how many there are;
// within a stage `done` never falls, and reaches `total` in the end.
// Calls come from any thread, but never two at a time. An exception thrown from it ends the work cleanly and reaches
// the caller: that is how a run is interrupted. May be empty.
using Progress = std::function<void(std::string_view stage, std::size_t done, std::size_t total)>;

}  // namespace spincat
