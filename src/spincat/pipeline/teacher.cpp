#include "spincat/pipeline/teacher.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "spincat/dataset/splits.h"
#include "spincat/geometry/random.h"
#include "spincat/pipeline/lesson.h"
#include "spincat/pipeline/task_kinds.h"
#include "spincat/pipeline/teach_tasks.h"

namespace spincat {
namespace {

constexpr std::uint64_t kCalibrationPurpose = 100;  // of derive_seed
constexpr int kFolds = 5;                           // of a calibration

// Whether the other ranks save more time than sending them the table takes. Rough: a core does 10^10 products a second,
// and 10^9 bytes a second leave this process.
bool pays_to_share(const FeatureTable& table, const TeachingPlan& plan, const TaskFarm& farm) {
  if (farm.ranks() < 2) {
    return false;
  }
  const auto rows = static_cast<double>(table.features.rows());
  const auto length = static_cast<double>(table.features.cols());
  const auto categories = static_cast<double>(table.categories.size());
  const auto objects = static_cast<double>(table.objects.size());
  const double gram = 0.5 * rows * rows * length;
  const double lesson = length * categories * (rows + 0.5 * categories * objects / kFolds);
  const double seconds_here = (gram + static_cast<double>(plan.lessons) * lesson) / 1e10 / farm.threads();
  const double bytes = 4.0 * (rows * length + rows * rows);
  const double seconds_sending = bytes * (farm.ranks() - 1) / 1e9;
  return 0.5 * seconds_here > seconds_sending;
}

// Objects of the fold, as indices into the table instead of into `objects`.
std::vector<std::uint32_t> picked(std::span<const std::uint32_t> objects, std::span<const std::uint32_t> indices) {
  std::vector<std::uint32_t> result;
  result.reserve(indices.size());
  for (const std::uint32_t i : indices) {
    result.push_back(objects[i]);
  }
  return result;
}

// The folds of a calibration. A category's only object is taught on in all of them.
std::vector<LessonPlan> calibration_lessons(const FeatureTable& table, std::span<const std::uint32_t> objects,
                                            std::uint64_t seed) {
  std::vector<std::uint32_t> labels;
  std::vector<std::size_t> in_category(table.categories.size(), 0);
  for (const std::uint32_t object : objects) {
    labels.push_back(table.objects[object].category);
    ++in_category[labels.back()];
  }
  std::vector<LessonPlan> lessons;
  for (Split& fold : stratified_folds(labels, kFolds, derive_seed(seed, kCalibrationPurpose))) {
    std::vector<std::uint32_t> judged;
    for (const std::uint32_t i : fold.test) {
      (in_category[labels[i]] > 1 ? judged : fold.train).push_back(i);
    }
    std::ranges::sort(fold.train);
    if (!judged.empty()) {
      lessons.push_back({picked(objects, fold.train), picked(objects, judged)});
    }
  }
  return lessons;
}

// Right and wrong votes of the judges of a fold, and their votes on the same objects as strangers.
void count_fold(const FeatureTable& table, const LessonPlan& lesson, const FeatureMatrix& margins,
                std::vector<JudgedObject>& votes, std::vector<JudgedObject>& strangers) {
  const auto categories = static_cast<std::uint32_t>(table.categories.size());
  const Familiarity familiarity = familiarity_of(table, lesson.taught);
  for (std::size_t i = 0; i < lesson.judged.size() * table.tested_rows; ++i) {
    const std::uint32_t object = lesson.judged[i / table.tested_rows];
    const std::span<const float> features =
        table.features_of(object, static_cast<std::uint32_t>(i % table.tested_rows));
    const std::uint32_t truth = table.objects[object].category;
    const auto row = static_cast<Eigen::Index>(i);
    const Ballot ballot = count_votes(categories, {margins.row(row).data(), static_cast<std::size_t>(margins.cols())});
    votes.push_back({ballot.weakest_margin, ballot.winner == truth, familiarity.of(features, ballot.winner)});
    if (categories > 2) {
      const Ballot as_stranger = ballot_without(ballot, truth);
      strangers.push_back({as_stranger.weakest_margin, false, familiarity.of(features, as_stranger.winner)});
    }
  }
}

TaskFarm::Tick telling(const Progress& progress, const char* stage, std::size_t tasks) {
  return [&progress, stage, tasks](std::size_t done) {
    if (progress) {
      progress(stage, done, tasks);
    }
  };
}

}  // namespace

Teacher::Teacher(const FeatureTable& table, const JudgeSettings& settings, TaskFarm& farm, TeachingPlan plan,
                 const Progress& progress)
    : table_(table), settings_(settings), farm_(&farm) {
  const bool shared = pays_to_share(table, plan, farm);
  if (shared) {
    farm.share(kTableTasks, [&] { return pack_table(table); });
  } else if (farm.ranks() > 1) {
    farm_ = &own_.emplace(farm.threads()).farm();
  }
  const std::size_t matrices = gram_columns(settings.kernel, table.blocks, table.features.cols()).size();
  if (table.local_size == 0 && may_share_gram(table.features.rows(), static_cast<Eigen::Index>(matrices))) {
    compute_gram(progress);
  }
  if (shared) {
    farm.share(kGramKeepingTasks, [&] { return pack_gram(own_gram_); });
  }
}

Teacher::Teacher(const FeatureTable& table, const SharedGram& gram, const JudgeSettings& settings, int threads)
    : table_(table), settings_(settings), own_(std::in_place, threads), farm_(&own_->farm()), gram_(&gram) {}

void Teacher::compute_gram(const Progress& progress) {
  const std::vector<GramTask> tasks = gram_tasks(table_, settings_.kernel);
  const Eigen::Index rows = table_.features.rows();
  for (const GramTask& task : tasks) {
    own_gram_.blocks.resize(std::max<std::size_t>(own_gram_.blocks.size(), task.matrix + 1),
                            Eigen::MatrixXf(rows, rows));
  }
  Job job;
  job.kind = kGramTasks;
  job.in_journal = false;
  job.context = [&] { return Packer().add(settings_.kernel).take(); };
  job.work = gram_work(table_, settings_.kernel);
  job.tasks = tasks.size();
  job.task = [&](std::size_t i) { return pack(tasks[i]); };
  job.deliver = [&](std::size_t i, const std::string& result) { put_strip(tasks[i], result, own_gram_); };
  farm_->run(job, telling(progress, "comparing objects", tasks.size()));
}

JudgeList Teacher::teach(std::span<const std::uint32_t> objects, const Progress& progress) {
  const std::vector<LessonPlan> lessons = {{{objects.begin(), objects.end()}, {}}};
  const std::vector<JudgesTask> tasks = judges_tasks(table_, settings_.kernel, lessons);
  std::vector<Judge> judges;
  Job job;
  job.kind = kJudgesTasks;
  job.in_journal = false;
  job.context = [&] { return pack_lessons(settings_, lessons); };
  job.work = judges_work(table_, *gram_, settings_, lessons);
  job.tasks = tasks.size();
  job.task = [&](std::size_t i) { return pack(tasks[i]); };
  job.deliver = [&](std::size_t, const std::string& result) {
    std::ranges::move(unpack_judges(result), std::back_inserter(judges));
  };
  farm_->run(job, telling(progress, "teaching judges", tasks.size()));
  return Lesson(table_, *gram_, objects, settings_).list(judges, farm_->threads());
}

Calibration Teacher::calibrate(std::span<const std::uint32_t> objects, std::uint64_t seed, const Progress& progress) {
  if (objects.size() < static_cast<std::size_t>(kFolds)) {
    return {};
  }
  const std::vector<LessonPlan> lessons = calibration_lessons(table_, objects, seed);
  const std::vector<JudgesTask> tasks = judges_tasks(table_, settings_.kernel, lessons);
  std::vector<JudgedObject> votes;
  std::vector<JudgedObject> strangers;
  FeatureMatrix margins;
  Job job;
  job.kind = kJudgesTasks;
  job.in_journal = false;
  job.context = [&] { return pack_lessons(settings_, lessons); };
  job.work = judges_work(table_, *gram_, settings_, lessons);
  job.tasks = tasks.size();
  job.task = [&](std::size_t i) { return pack(tasks[i]); };
  job.deliver = [&](std::size_t i, const std::string& result) {
    const auto& [number, first, last] = tasks[i];
    const LessonPlan& lesson = lessons[number];
    const FeatureMatrix part = unpack_margins(result, lesson.judged.size() * table_.tested_rows);
    margins.conservativeResize(part.rows(), last);
    margins.rightCols(last - first) = part;
    if (i + 1 == tasks.size() || tasks[i + 1].lesson != number) {
      count_fold(table_, lesson, margins, votes, strangers);
      margins.resize(0, 0);
    }
  };
  farm_->run(job, telling(progress, "calibrating", tasks.size()));
  return fit_calibration(votes, strangers);
}

Familiarity familiarity_of(const FeatureTable& table, std::span<const std::uint32_t> objects) {
  if (table.local_size > 0) {
    return {};  // local features are compared by the words of a codebook alone
  }
  const Eigen::Index length = table.features.cols() / table.parts;
  constexpr std::uint32_t kMostViews = 4;  // of an object: more cost each vote time and tell hardly more
  const std::uint32_t views = std::min(table.tested_rows, kMostViews);
  FeatureMatrix features(static_cast<Eigen::Index>(objects.size() * views), length);
  std::vector<std::uint32_t> labels;
  for (const std::uint32_t object : objects) {
    for (std::uint32_t view = 0; view < views; ++view) {
      features.row(static_cast<Eigen::Index>(labels.size())) =
          table.features.row(static_cast<Eigen::Index>(object) * table.rows_per_object + view).head(length);
      labels.push_back(table.objects[object].category);
    }
  }
  return make_familiarity(std::move(features), std::move(labels), static_cast<std::uint32_t>(table.categories.size()),
                          views);
}

}  // namespace spincat
