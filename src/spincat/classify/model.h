// What training leaves behind: everything needed to name an object.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "spincat/describe/kinds.h"
#include "spincat/judge/calibration.h"
#include "spincat/judge/familiarity.h"
#include "spincat/judge/judge_list.h"
#include "spincat/settings/settings.h"

namespace spincat {

// The newest version of the model file that this library reads, which is the one it writes, and the oldest one. Models
// of older versions lack what answers are made of now: they are to be trained again.
inline constexpr std::uint32_t kModelVersion = 2;
inline constexpr std::uint32_t kOldestModelVersion = 2;

struct Model {
  Settings settings;
  std::vector<std::string> categories;  // n, in the order of the judges
  JudgeList judges;
  Calibration calibration;
  Familiarity familiarity;
  std::string dataset;                       // what it was trained on, as the user named it
  std::vector<std::uint32_t> object_counts;  // n: training objects of each category, copies not counted
  KindCounts kinds;                          // of the training objects
  std::string made_by;                       // "spincat 0.1.0"
  std::filesystem::path file;                // it was read from; empty for one that was trained here

  std::size_t feature_length() const { return judges.feature_length(); }
};

// Writes the model file: self-describing, with a version and a checksum; beside the target first, then renamed. The
// same model gives the same bytes. Throws as write_file_atomically does.
void write_model(const std::filesystem::path& file, const Model& model);

// Reads a model file. Everything in it is checked before it is used: names, counts, ranges, finite numbers.
// Throws InputError when the file is missing, no spincat model, written by a newer version, or damaged.
Model read_model(const std::filesystem::path& file);

// Whether the file begins as a spincat file does; false when it cannot be read.
bool is_model_file(const std::filesystem::path& file);

}  // namespace spincat
