#include "spincat/pipeline/task_kinds.h"

#include <fmt/format.h>

#include <functional>
#include <map>

#include "spincat/error.h"
#include "spincat/pipeline/classify_tasks.h"
#include "spincat/pipeline/dense_object.h"
#include "spincat/pipeline/describe_tasks.h"

namespace spincat {

WorkFactory pipeline_work() {
  using Maker = std::function<Work(std::string_view context)>;
  static const std::map<std::string_view, Maker> makers = {{kImagesTasks, make_images_work},
                                                           {kSumsTasks, make_sums_work},
                                                           {kDescribeTasks, make_describe_work},
                                                           {kClassifyTasks, make_classify_work}};
  return [](std::string_view kind, std::string_view context) {
    const auto maker = makers.find(kind);
    if (maker == makers.end()) {
      throw RunError(fmt::format("no rank can do '{}'", kind));
    }
    return maker->second(context);
  };
}

}  // namespace spincat
