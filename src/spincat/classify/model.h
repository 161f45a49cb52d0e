// What training leaves behind: everything needed to name an object.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "spincat/settings/settings.h"

#pragma GCC visibility push(default)
namespace spincat {

// The newest version of the model file that this library reads, which is the one it writes, and the oldest one. Models
// of older versions lack what answers are made of now: they are to be trained again.
inline constexpr std::uint32_t kModelVersion = 3;
inline constexpr std::uint32_t kOldestModelVersion = 3;

struct ModelData;  // model_data.h

// Made by train() and read_model(), and never changed. Copies share what they hold; any number of threads may use one.
class Model {
 public:
  Model(ModelData data);  // NOLINT(google-explicit-constructor): the same, and no longer to be changed

  const Settings& settings() const;
  const std::vector<std::string>& categories() const;       // n, in the order of the judges
  const std::vector<std::uint32_t>& object_counts() const;  // n: training objects of each category, copies not counted
  std::uint32_t meshes() const;                             // of the training objects
  std::uint32_t clouds() const;
  const std::string& dataset() const;         // what it was trained on, as the user named it
  const std::string& made_by() const;         // "spincat 0.2.0"
  const std::filesystem::path& file() const;  // it was read from; empty for one that was trained here
  std::size_t feature_length() const;         // how many features an object gives
  std::size_t judge_count() const;            // n (n - 1) / 2
  bool tells_strangers() const;  // whether it learned from a background what belongs to none of its categories
  double least_known() const;    // Classification::known below which it calls an object unknown; 0 where it tells none

  // For the library itself.
  const ModelData& data() const { return *data_; }

 private:
  std::shared_ptr<const ModelData> data_;
};

// Writes the model file: self-describing, with a version and a checksum; beside the target first, then renamed. The
// same model gives the same bytes. Throws RunError when it cannot be written.
void write_model(const std::filesystem::path& file, const Model& model);

// Reads a model file. Everything in it is checked before it is used: names, counts, ranges, finite numbers.
// Throws InputError when the file is missing, no spincat model, written by a newer version, or damaged.
Model read_model(const std::filesystem::path& file);

// Whether the file begins as a spincat file does; false when it cannot be read.
bool is_model_file(const std::filesystem::path& file);

}  // namespace spincat
#pragma GCC visibility pop
