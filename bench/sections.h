// The parts of the report; each is one JSON object.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

namespace spincat::bench {

// How fast this machine adds 16 bytes to random places of a small table, computes alpha and beta, and reads memory: on
// one core, in the terms of the engine's inner loops.
nlohmann::ordered_json machine_limits(int rounds);

// The engine against the plain reference, PCL (where it was found) and itself on two threads. `scan` may be empty: then
// only tori are used.
nlohmann::ordered_json spin_race(const std::filesystem::path& scan, int rounds);

// Milliseconds an object by stage (read, prepare, spin images, encode), over all object files below `folder`.
nlohmann::ordered_json stage_times(const std::filesystem::path& folder, int rounds);

}  // namespace spincat::bench
