// Names 3D objects by a model that `spincat train` has made.
#include <cstdio>
#include <exception>
#include <string>

#include "spincat/classify/classify.h"
#include "spincat/error.h"

namespace {

// One line: the file, its name, how sure that is, and what it would have been otherwise.
void name_object(const spincat::Model& model, const std::string& file) {
  const spincat::Classification answer = spincat::classify_file(model, file);
  const std::string& name = model.categories[answer.ballot.winner];
  const std::string& runner_up = model.categories[answer.ballot.runner_up];
  std::printf("%s: %s (confidence %.2f, runner-up %s)\n", file.c_str(), name.c_str(), answer.confidence,
              runner_up.c_str());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: name_objects MODEL FILE...\n");
    return 2;
  }
  try {
    const spincat::Model model = spincat::read_model(argv[1]);
    int status = 0;
    for (int i = 2; i < argc; ++i) {
      try {
        name_object(model, argv[i]);
      } catch (const spincat::Error& error) {  // this file is no use, the next one may be
        std::fprintf(stderr, "name_objects: %s\n", error.what());
        status = 1;
      }
    }
    return status;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "name_objects: %s\n", error.what());
    return 1;
  }
}
