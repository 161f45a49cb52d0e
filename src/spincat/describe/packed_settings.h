// Settings as bytes, for messages between ranks: as JSON, which has all of them. Private to the library, not installed.
#pragma once

#include <nlohmann/json.hpp>

#include "spincat/parallel/packing.h"
#include "spincat/settings/settings_json.h"

namespace spincat {

inline void fields(Packer& packer, const Settings& settings) {
  packer(settings_to_json(settings).dump());
}

inline void fields(Unpacker& unpacker, Settings& settings) {
  settings = settings_from_json(nlohmann::json::parse(unpacker.get_text()));
}

}  // namespace spincat
