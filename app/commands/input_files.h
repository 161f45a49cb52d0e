// The objects that a command is to work on.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace spincat::app {

// A file, or what is wrong with a folder that should have held some.
struct InputFile {
  std::filesystem::path file;
  std::string problem;
};

// Files as they are; folders stand for all object files below them, sorted. Folders that cannot be read, those
// where there is no object and those that hold objects in formats that are not read are told by their problem.
std::vector<InputFile> input_files(const std::vector<std::filesystem::path>& arguments);

}  // namespace spincat::app
