#include "app/ranks/farm_run.h"

#include <fmt/format.h>

#include <utility>

#include "app/terminal/messages.h"
#include "spincat/error.h"
#include "spincat/files/locked_file.h"
#include "spincat/files/paths.h"
#include "spincat/parallel/placement.h"
#include "spincat/parallel/task_farm.h"
#include "spincat/settings/settings_json.h"
#include "spincat/version.h"

namespace spincat::app {

namespace fs = std::filesystem;

namespace {

std::string finished_tasks(std::size_t count) {
  return fmt::format("{} finished task{}", count, count == 1 ? "" : "s");
}

}  // namespace

FarmRun::FarmRun(TaskFarm& farm, const RunOptions& run) : farm_(farm), run_(run) {
  const Placement placement = farm.placement();
  const int threads = thread_count(run.threads, placement);
  farm.use_threads(threads, run.threads);
  if (farm.ranks() > 1 && !run.quiet) {
    for (const std::string& warning : placement_warnings(threads, placement)) {
      message(warning);
    }
  }
}

FarmRun::~FarmRun() {
  farm_.use_journal(nullptr);
}

void FarmRun::keep_journal(const fs::path& output, const std::function<RunIdentity()>& identity) {
  fs::path file;
  if (run_.journal) {
    file = *run_.journal == "none" ? fs::path() : *run_.journal;
  } else if (farm_.ranks() > 1 && !output.empty()) {
    std::error_code error;
    const fs::file_status status = fs::status(output, error);
    if (is_regular_or_missing(status)) {
      file = output.string() + ".journal";
    }
  }
  if (file.empty()) {
    return;
  }
  // The other split cuts the work into other tasks.
  RunIdentity whose = identity();
  whose.settings += " " + run_.divide;
  const auto go_on_without = [](const RunError& problem) {
    message(fmt::format("{}; going on without a journal", problem.what()));
  };
  try {
    journal_.emplace(file, whose);
  } catch (const InUseError&) {
    throw;
  } catch (const RunError& problem) {
    if (run_.journal) {
      throw;
    }
    go_on_without(problem);
    return;
  }
  using TellFailure = std::function<void(const RunError&)>;
  farm_.use_journal(&*journal_, run_.journal ? TellFailure() : TellFailure(go_on_without));
  found_ = journal_->size();
  if (found_ > 0 && !run_.quiet) {
    message(fmt::format("{}: has {}", file.string(), finished_tasks(found_)));
  }
}

Execution FarmRun::execution(Progress progress) const {
  Execution execution;
  execution.threads = farm_.threads();
  execution.farm = &farm_;
  execution.split = run_.split();
  execution.progress = std::move(progress);
  return execution;
}

void FarmRun::finish() {
  if (journal_) {
    farm_.use_journal(nullptr);
    if (found_ > 0 && !run_.quiet) {  // as many as were cut alike
      message(
          fmt::format("{}: {} of {} were of use", journal_->file().string(), farm_.resumed(), finished_tasks(found_)));
    }
    journal_->remove();
    journal_.reset();
  }
  if (farm_.ranks() > 1 && !run_.quiet) {
    message(farm_.report().text());
  }
}

std::string identity_of(const Dataset& dataset) {
  FilesIdentity data;
  for (const DatasetObject& object : dataset.objects) {
    data.add(object.file);
  }
  for (const std::filesystem::path& file : dataset.others) {
    data.add(file);
  }
  return data.text();
}

std::string settings_identity(const std::string& command, const Settings& settings, const std::string& more) {
  return fmt::format("spincat {} {} {} {}", kVersion, command, settings_to_json(settings).dump(), more);
}

}  // namespace spincat::app
