// The subcommands. Each one declares its options on its CLI::App and returns what is to be run when it was chosen, with
// the other ranks of this run at its service; that returns the exit code and throws spincat::Error.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace spincat {
class TaskFarm;
}

namespace spincat::app {

using Command = std::function<int(TaskFarm& farm)>;

Command add_train(CLI::App& parent);
Command add_classify(CLI::App& parent);
Command add_evaluate(CLI::App& parent);
Command add_sweep(CLI::App& parent);
Command add_spin(CLI::App& parent);
Command add_info(CLI::App& parent);
Command add_camera(CLI::App& parent);

}  // namespace spincat::app
