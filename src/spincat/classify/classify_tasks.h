// Naming many files on all threads and ranks of a farm.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "spincat/classify/classify.h"
#include "spincat/classify/model.h"
#include "spincat/describe/division.h"
#include "spincat/io/read_limits.h"
#include "spincat/parallel/task.h"
#include "spincat/parallel/task_farm.h"

namespace spincat {

// The name of this kind of work, as ranks tell each other.
inline constexpr const char* kClassifyTasks = "names of objects";

// What became of one file.
struct Answer {
  std::optional<Classification> classification;
  std::string error;  // the whole line, when there is no classification
};

// Which files, and by which model. What is referred to must outlive the call.
struct ClassifyJob {
  const Model& model;
  const std::filesystem::path& model_file;  // from which other ranks read it
  std::size_t files = 0;
  std::function<const std::filesystem::path&(std::size_t)> file;
  Division division = Division::sums;
  ReadLimits limits = {};
};

// Names every file and hands the answers on in order, on the calling thread. Objects with many spin points, or all of
// them where the division is `images`, are shared out by their spin points. The answers are the same for any number of
// threads and ranks; their times are not. `tick` gets the number of files that are done.
void classify_files(TaskFarm& farm, const ClassifyJob& job, const std::function<void(std::size_t i, Answer)>& deliver,
                    const TaskFarm::Tick& tick);

// Its work, for other ranks.
Work make_classify_work(std::string_view context);

}  // namespace spincat
