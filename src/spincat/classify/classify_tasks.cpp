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

// All but the ballot. The margins are all there is to that, and come first: the rest is counted again.
void fields(auto& archive, MessageOf<Classification> auto& classification) {
  auto& [ballot, confidence, known, kind_mismatch, seconds] =
      classification;  // does not compile when a member is forgotten
  static_cast<void>(ballot);
  archive(confidence, known, kind_mismatch, seconds);
}

namespace {

Answer answer_for(const Model& model, const std::filesystem::path& file, const ReadLimits& limits,
                  const EncodePrepared& encoder = {}) {
  try {
    return {classify_file(model, file, limits, encoder), {}};
  } catch (const std::bad_alloc&) {
    return {{}, file.string() + ": not enough memory for it"};
  } catch (const Error& error) {
    return {{}, error.what()};
  } catch (const std::exception& error) {  // whatever it is, the other files are named
    return {{}, file.string() + ": " + error.what()};
  }
}

struct ClassifyContext {
  ReadLimits limits;
  std::string model;  // its file
};

void fields(auto& archive, MessageOf<ClassifyContext> auto& context) {
  auto& [limits, model] = context;
  archive(limits, model);
}

std::string pack_answer(const Answer& answer) {
  Packer packer;
  packer(answer.error);
  if (answer.classification) {
    std::vector<float> margins;
    for (const Vote& vote : answer.classification->ballot.votes) {
      margins.push_back(vote.margin);
    }
    packer(margins, *answer.classification);
  }
  return packer.take();
}

Answer unpack_answer(std::string_view bytes, std::size_t categories) {
  Unpacker unpacker(bytes);
  Answer answer{{}, unpacker.next<std::string>()};
  if (!unpacker.empty()) {
    const auto margins = unpacker.next<std::vector<float>>();
    unpacker(answer.classification.emplace());
    answer.classification->ballot = count_votes(static_cast<std::uint32_t>(categories), margins);
  }
  return answer;
}

}  // namespace

Work make_classify_work(std::string_view context) {
  const auto [read_limits, model_file] = unpack<ClassifyContext>(context);
  const auto model = std::make_shared<const Model>(read_model(std::filesystem::path(model_file)));
  return throwing_problems([model, limits = read_limits](std::string_view file) {
    return pack_answer(answer_for(*model, std::filesystem::path(file), limits));
  });
}

void classify_files(const Model& model, std::span<const std::filesystem::path> files, const Execution& execution,
                    const std::function<void(std::size_t i, const Answer& answer)>& deliver) {
  const FarmExecution run(execution);
  const TaskFarm::Tick tick = run.ticking("naming objects", files.size());
  if (spreads_points(model.settings(), run.split)) {
    for (std::size_t i = 0; i < files.size(); ++i) {
      const EncodePrepared encoder = encode_on(*run.farm, model.settings(), run.split, [&](std::size_t) { tick(i); });
      deliver(i, answer_for(model, files[i], run.limits, encoder));
    }
    tick(files.size());
    return;
  }
  Job tasks;
  tasks.kind = kClassifyTasks;
  tasks.stays_here = model.file().empty();
  tasks.context = [&](Packer& packer) { packer(ClassifyContext{run.limits, model.file().string()}); };
  tasks.work = [&](std::string_view file) {
    return pack_answer(answer_for(model, std::filesystem::path(file), run.limits));
  };
  tasks.is_worth_keeping = has_no_problem;
  tasks.tasks = files.size();
  tasks.task = [&](std::size_t i) { return files[i].string(); };
  tasks.deliver = [&](std::size_t i, const std::string& result) {
    deliver(i, unpack_answer(result, model.categories().size()));
  };
  run.farm->run(tasks, tick);
}

}  // namespace spincat
