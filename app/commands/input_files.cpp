#include "app/commands/input_files.h"

#include "spincat/dataset/object_files.h"

namespace spincat::app {

namespace fs = std::filesystem;

namespace {

std::vector<InputFile> files_below(const fs::path& folder) {
  std::vector<InputFile> files;
  const ObjectFiles found = object_files_below(folder);
  for (const fs::path& file : found.files) {
    files.push_back({file, {}});
  }
  for (const auto& [where, error] : found.unread_folders) {
    files.push_back({where, "cannot be read: " + error.message()});
  }
  if (!found.unread_files.empty()) {
    files.push_back({folder, "holds " + found.unread_files.text()});
  }
  if (files.empty()) {
    files.push_back({folder, "holds no object files"});
  }
  return files;
}

}  // namespace

std::vector<InputFile> input_files(const std::vector<fs::path>& arguments) {
  std::vector<InputFile> inputs;
  for (const fs::path& argument : arguments) {
    std::error_code error;
    if (fs::is_directory(argument, error)) {
      const std::vector<InputFile> below = files_below(argument);
      inputs.insert(inputs.end(), below.begin(), below.end());
    } else {
      inputs.push_back({argument, {}});
    }
  }
  return inputs;
}

}  // namespace spincat::app
