#include "spincat/rank_work.h"

#include <fmt/format.h>

#include <functional>
#include <map>
#include <memory>

#include "spincat/classify/classify_tasks.h"
#include "spincat/describe/dense_object.h"
#include "spincat/describe/describe_tasks.h"
#include "spincat/error.h"
#include "spincat/evaluate/tested_objects.h"
#include "spincat/evaluate/trial.h"
#include "spincat/train/background.h"
#include "spincat/train/train_tasks.h"

namespace spincat {

WorkFactory rank_work() {
  using Maker = std::function<RankWork(std::string_view context)>;
  const auto kept = std::make_shared<RankState>();
  const std::map<std::string_view, Maker> makers = {
      {kImagesTasks, make_images_work},
      {kSumsTasks, make_sums_work},
      {kDescribeTasks,
       [kept](std::string_view context) { return make_describe_work(context, kept->rows, [kept] { *kept = {}; }); }},
      {kBackgroundTasks, make_background_work},
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
