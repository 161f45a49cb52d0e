// Data sets as lines of text, so that tests compare them whole.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "spincat/dataset/dataset.h"

namespace spincat::test {

using Lines = std::vector<std::string>;

// "FILE CATEGORY[ SPLIT]" for each object, files relative to a folder.
inline Lines object_lines(const Dataset& dataset, const std::filesystem::path& folder) {
  Lines lines;
  for (const DatasetObject& object : dataset.objects) {
    lines.push_back(object.file.lexically_relative(folder).string() + " " + dataset.categories.at(object.category) +
                    (object.split.empty() ? "" : " " + object.split));
  }
  return lines;
}

inline Lines skipped_lines(const Dataset& dataset, const std::filesystem::path& folder) {
  Lines lines;
  for (const SkippedObject& skipped : dataset.skipped) {
    lines.push_back(skipped.file.lexically_relative(folder).string() + ": " + skipped.reason);
  }
  return lines;
}

}  // namespace spincat::test
