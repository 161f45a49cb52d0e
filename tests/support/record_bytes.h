// The bytes of a record file.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "spincat/files/file.h"
#include "spincat/files/record_file.h"
#include "support/temp_dir.h"

namespace spincat::test {

inline std::string record_bytes(std::string_view kind, std::uint32_t version, const nlohmann::json& content) {
  const TempDir folder;
  write_record(folder / "record", kind, version, content);
  return read_file(folder / "record");
}

}  // namespace spincat::test
