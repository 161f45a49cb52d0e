// The page of classify.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/options.h"
#include "app/terminal/answer_printer.h"
#include "spincat/classify/classify.h"
#include "spincat/classify/model.h"

namespace spincat::app {

struct NamedFile {
  std::filesystem::path file;
  Answer answer;
};

// Writes the report of all answers. The objects are read again and their evidence is worked out here, on the threads of
// the first process: answers stay a few bytes on their way between processes, and the page is the same for any number
// of them. Throws as write_file_atomically does.
void write_classify_report(const std::filesystem::path& report, const std::filesystem::path& model_file,
                           const Model& model, const std::vector<NamedFile>& named, const AnswerLook& look,
                           const ReadLimits& limits, const RunOptions& run);

}  // namespace spincat::app
