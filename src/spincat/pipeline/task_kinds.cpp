#include "spincat/pipeline/task_kinds.h"

#include <fmt/format.h>

#include <functional>
#include <map>
#include <memory>

#include "spincat/error.h"
#include "spincat/pipeline/classify_tasks.h"
#include "spincat/pipeline/dense_object.h"
#include "spincat/pipeline/describe_tasks.h"
#include "spincat/pipeline/teach_tasks.h"
#include "spincat/pipeline/test_objects.h"
#include "spincat/pipeline/trial.h"

namespace spincat {

WorkFactory pipeline_work() {
  using Maker = std::function<RankWork(std::string_view context)>;
  const auto kept = std::make_shared<KeptData>();
  const std::map<std::string_view, Maker> makers = {
      {kImagesTasks, make_images_work},
      {kSumsTasks, make_sums_work},
      {kDescribeTasks, [kept](std::string_view context) { return make_describe_work(context, *kept); }},
      {kClassifyTasks, make_classify_work},
      {kTestedTasks, make_tested_work},
      {kTableTasks, [kept](std::string_view context) { return make_table_work(context, *kept); }},
      {kGramTasks, [kept](std::string_view context) { return make_gram_work(context, *kept); }},
      {kJudgesTasks, [kept](std::string_view context) { return make_judges_work(context, *kept); }},
      {kTrialTasks, [kept](std::string_view context) { return make_trial_work(context, *kept); }}};
  return [makers](std::string_view kind, std::string_view context) -> RankWork {
    const auto maker = makers.find(kind);
    if (maker == makers.end()) {
      throw RunError(fmt::format("no rank can do '{}'", kind));
    }
    return maker->second(context);
  };
}

}  // namespace spincat
