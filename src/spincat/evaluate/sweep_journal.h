// What an interrupted sweep has found so far.
//
// Lines of JSON, each with a blank and its CRC-32 (eight digits) behind it. The first says which sweep it is; every
// other one is a point. A line counts when it is whole: the last one, cut off by a power failure, is written over.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "spincat/evaluate/sweep.h"
#include "spincat/files/locked_file.h"

namespace spincat {

class SweepJournal {
 public:
  // Reads the journal, or begins one where there is none. No file: nothing is kept. Throws InputError when the file is
  // the journal of another sweep than `identity`, of an older spincat (without checksums) or none at all, or when a
  // line is damaged; RunError when it cannot be written or another run is using it.
  SweepJournal(const std::filesystem::path& file, const nlohmann::ordered_json& identity);

  // The point with these values, where it is known.
  const SweepPoint* find(const std::vector<std::string>& values) const;

  // Adds a line, and waits until it is on the disk.
  void add(const SweepPoint& point);

 private:
  void read(const std::string& text, const nlohmann::ordered_json& identity);
  void append(const std::string& line);

  std::optional<LockedFile> file_;  // nothing: nothing is kept
  std::size_t whole_ = 0;           // bytes of whole lines
  std::map<std::vector<std::string>, SweepPoint> points_;
};

}  // namespace spincat
