#include "app/terminal/command_line.h"

namespace spincat::app {
namespace {

std::vector<std::string>& kept() {
  static std::vector<std::string> words = {"spincat"};
  return words;
}

}  // namespace

void keep_command_line(int argc, char** argv) {
  kept().assign({"spincat"});
  for (int i = 1; i < argc; ++i) {
    kept().emplace_back(argv[i]);
  }
}

const std::vector<std::string>& command_line() {
  return kept();
}

}  // namespace spincat::app
