// Naming: from an object and a model to a ballot.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>

#include "spincat/classify/model.h"
#include "spincat/describe/describe.h"
#include "spincat/execution.h"
#include "spincat/geometry/object.h"
#include "spincat/io/read_limits.h"
#include "spincat/judge/ballot.h"

#pragma GCC visibility push(default)
namespace spincat {

struct Classification {
  Ballot ballot;            // categories as indices into Model::categories
  double confidence = 0.0;  // in (0, 1): how likely the winner is right, by the model's calibration, if the object is
                            // of one of the categories
  double known = 1.0;  // in (0, 1]: how likely it is, rather than something else; 1 where the model tells no strangers
  std::string kind_mismatch;  // why the judges should not be trusted with this object (kinds.h); mostly empty
  StageSeconds seconds;
};

// Prepares, describes and judges an object exactly as training did, `encoder` as in describe(). Deterministic. Throws
// InputError (without a file name) when the object has no extent or does not fit the model.
Classification classify(const Model& model, const Object& object, const EncodePrepared& encoder = {});

// The same for an object in a file; what is thrown names the file.
Classification classify_file(const Model& model, const std::filesystem::path& file, const ReadLimits& limits = {},
                             const EncodePrepared& encoder = {});

// What became of one file.
struct Answer {
  std::optional<Classification> classification;
  std::string error;  // the whole line, when there is no classification
};

// Names every file and hands the answers on in order, on the calling thread. Objects with many spin points, or all of
// them where the split is `return_images`, are shared out by their spin points. The answers are the same for any number
// of threads and ranks; their times are not. What is wrong with a file is its answer, and never an error.
void classify_files(const Model& model, std::span<const std::filesystem::path> files, const Execution& execution,
                    const std::function<void(std::size_t i, const Answer& answer)>& deliver);

}  // namespace spincat
#pragma GCC visibility pop
