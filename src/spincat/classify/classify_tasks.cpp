#include "spincat/classify/classify_tasks.h"

#include <exception>
#include <memory>
#include <new>
#include <utility>
#include <vector>

#include "spincat/classify/classify.h"
#include "spincat/describe/describe_tasks.h"
#include "spincat/describe/packed_features.h"
#include "spincat/describe/packed_limits.h"
#include "spincat/describe/rank_problems.h"
#include "spincat/error.h"
#include "spincat/parallel/farm_execution.h"
#include "spincat/parallel/packing.h"

namespace spincat {
namespace {

Answer answer_for(const Model& model, const std::filesystem::path& file, const ReadLimits& limits,
                  const EncodePrepared& elsewhere = {}) {
  try {
    return {classify_file(model, file, limits, elsewhere), {}};
  } catch (const std::bad_alloc&) {
    return {{}, file.string() + ": not enough memory for it"};
  } catch (const Error& error) {
    return {{}, error.what()};
  } catch (const std::exception& error) {  // whatever it is, the other files are named
    return {{}, file.string() + ": " + error.what()};
  }
}

// The margins are all there is to a ballot: the rest is counted again.
std::string pack(const Answer& answer) {
  Packer packer;
  packer.add(std::string_view(answer.error));
  if (answer.classification) {
    std::vector<float> margins;
    for (const Vote& vote : answer.classification->ballot.votes) {
      margins.push_back(vote.margin);
    }
    packer.add(std::span<const float>(margins)).add(answer.classification->confidence);
    packer.add(std::string_view(answer.classification->kind_mismatch));
    pack_seconds(packer, answer.classification->seconds);
  }
  return packer.take();
}

Answer unpack_answer(std::string_view bytes, std::size_t categories) {
  Unpacker fields(bytes);
  Answer answer;
  answer.error = fields.get_text();
  if (!fields.empty()) {
    Classification& c = answer.classification.emplace();
    c.ballot = count_votes(static_cast<std::uint32_t>(categories), fields.get_values<float>());
    c.confidence = fields.get<double>();
    c.kind_mismatch = fields.get_text();
    c.seconds = unpack_seconds(fields);
  }
  return answer;
}

}  // namespace

Work make_classify_work(std::string_view context) {
  Unpacker fields(context);
  const ReadLimits limits = unpack_limits(fields);
  const auto model = std::make_shared<const Model>(read_model(std::filesystem::path(fields.rest())));
  return throwing_problems(
      [model, limits](std::string_view file) { return pack(answer_for(*model, std::filesystem::path(file), limits)); });
}

void classify_files(const Model& model, std::span<const std::filesystem::path> files, const Execution& execution,
                    const std::function<void(std::size_t i, const Answer& answer)>& deliver) {
  const FarmExecution run(execution);
  const TaskFarm::Tick tick = run.ticking("naming objects", files.size());
  if (shares_out_points(model.settings(), run.split)) {
    for (std::size_t i = 0; i < files.size(); ++i) {
      const EncodePrepared elsewhere = encode_on(*run.farm, model.settings(), run.split, [&](std::size_t) { tick(i); });
      deliver(i, answer_for(model, files[i], run.limits, elsewhere));
    }
    tick(files.size());
    return;
  }
  Job tasks;
  tasks.kind = kClassifyTasks;
  tasks.stays_here = model.file().empty();
  tasks.context = [&](Packer& packer) {
    pack_limits(packer, run.limits);
    packer.add_rest(model.file().string());
  };
  tasks.work = [&](std::string_view file) { return pack(answer_for(model, std::filesystem::path(file), run.limits)); };
  tasks.is_worth_keeping = has_no_problem;
  tasks.tasks = files.size();
  tasks.task = [&](std::size_t i) { return files[i].string(); };
  tasks.deliver = [&](std::size_t i, const std::string& result) {
    deliver(i, unpack_answer(result, model.categories().size()));
  };
  run.farm->run(tasks, tick);
}

}  // namespace spincat
