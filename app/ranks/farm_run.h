// How a command uses the farm: its options, its journal, and what is told about it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "app/options.h"
#include "spincat/execution.h"
#include "spincat/parallel/journal.h"
#include "spincat/settings/settings.h"

namespace spincat::app {

class FarmRun {
 public:
  // Sets the threads, and warns of what ruins parallel runs.
  FarmRun(TaskFarm& farm, const RunOptions& run);
  ~FarmRun();
  FarmRun(const FarmRun&) = delete;
  FarmRun& operator=(const FarmRun&) = delete;

  // Keeps finished tasks where the user wants them; with several ranks also where he did not say so: beside `output`,
  // unless this is empty or no regular file. Throws as Journal does, but for a journal that the user did not ask for
  // and that cannot be written: then he is told, and there is none.
  // `identity` is only asked for where there is a journal.
  void keep_journal(const std::filesystem::path& output, const std::function<RunIdentity()>& identity);

  // This farm, with what the user said about splitting the work.
  Execution execution(Progress progress) const;

  // The result is where it should be: the journal goes, and one line tells how the work was shared out.
  void finish();

 private:
  TaskFarm& farm_;
  const RunOptions& run_;
  std::optional<Journal> journal_;
  std::size_t found_ = 0;  // finished tasks, when it was opened
};

// What decides about the results of a command: its name, settings, and whatever else it depends on.
std::string settings_identity(const std::string& command, const Settings& settings, const std::string& more = "");

// Which objects a command works on.
std::string identity_of(const Dataset& dataset);

}  // namespace spincat::app
