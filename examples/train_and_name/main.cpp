// Learns from a data set, keeps the model in a file, and names objects by it.
#include <spincat/spincat.h>

#include <cstddef>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace {

void print_progress(std::string_view stage, std::size_t done, std::size_t total) {
  if (done == total) {
    std::fprintf(stderr, "%.*s: %zu done\n", static_cast<int>(stage.size()), stage.data(), total);
  }
}

// One line: the file, its name, how sure that is, and what it would have been otherwise.
void print_answer(const spincat::Model& model, const std::filesystem::path& file,
                  const spincat::Classification& answer) {
  const std::string& name = model.categories()[answer.ballot.winner];
  const std::string& runner_up = model.categories()[answer.ballot.runner_up];
  std::printf("%s: %s (confidence %.2f, runner-up %s)\n", file.c_str(), name.c_str(), answer.confidence,
              runner_up.c_str());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) {
    std::fprintf(stderr, "usage: train_and_name DATASET MODEL FILE...\n");
    return 2;
  }
  try {
    spincat::Execution execution;
    execution.threads = 2;
    execution.progress = print_progress;

    // A folder with a folder of objects for each category, a CSV list, or a .cla file.
    const spincat::Dataset dataset = spincat::read_dataset({argv[1]});
    const spincat::TrainResult trained = spincat::train(dataset, spincat::preset("default"), execution);
    for (const spincat::SkippedObject& object : trained.skipped) {
      std::fprintf(stderr, "train_and_name: left out %s: %s\n", object.file.c_str(), object.reason.c_str());
    }
    spincat::write_model(argv[2], trained.model);

    // Another program would begin here.
    const spincat::Model model = spincat::read_model(argv[2]);
    const std::vector<std::filesystem::path> files(argv + 3, argv + argc);
    execution.progress = {};
    int status = 0;
    spincat::classify_files(model, files, execution, [&](std::size_t i, const spincat::Answer& answer) {
      if (answer.classification) {
        print_answer(model, files[i], *answer.classification);
      } else {  // this file is no use, the next one may be
        std::fprintf(stderr, "train_and_name: %s\n", answer.error.c_str());
        status = 1;
      }
    });
    return status;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "train_and_name: %s\n", error.what());
    return 1;
  }
}
