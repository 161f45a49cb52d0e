// What this program is and can do.
#pragma once

#include <string>

namespace spincat::app {

// The answer to --version: "spincat 0.2.0" in a line of its own, then a line for each thing in which builds and
// machines differ. Throws InputError when the environment variable SPINCAT_SIMD names no path of this machine.
std::string version_text();

}  // namespace spincat::app
