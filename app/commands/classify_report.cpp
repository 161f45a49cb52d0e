#include "app/commands/classify_report.h"

#include <mutex>
#include <new>

#include "app/terminal/command_line.h"
#include "app/terminal/progress_bar.h"
#include "spincat/classify/evidence.h"
#include "spincat/error.h"
#include "spincat/files/file.h"
#include "spincat/io/read_object.h"
#include "spincat/parallel/for_each.h"
#include "spincat/report/object_page.h"

namespace spincat::app {
namespace {

PageObject explained(const Model& model, const NamedFile& named, const PageDetail& detail, const AnswerLook& look,
                     const ReadLimits& limits) {
  const std::string file = named.file.string();
  if (!named.answer.classification) {
    return page_object_error(file, std::string(without_file(named.answer.error, file)));
  }
  const Classification& found = *named.answer.classification;
  try {
    const Object object = read_object(named.file, limits);
    const Evidence evidence = explain(model, object, found.ballot);
    return page_object(file, found, model, object, evidence, detail, look.rejects(found, model));
  } catch (const Error& error) {  // it was there a moment ago
    return page_object_error(file, std::string(without_file(error.what(), file)));
  } catch (const std::bad_alloc&) {
    return page_object_error(file, "not enough memory for it");
  }
}

}  // namespace

void write_classify_report(const std::filesystem::path& report, const std::filesystem::path& model_file,
                           const Model& model, const std::vector<NamedFile>& named, const AnswerLook& look,
                           const ReadLimits& limits, const RunOptions& run) {
  const PageDetail detail = page_detail(named.size());
  std::vector<PageObject> objects(named.size());
  {
    ProgressBar bar(run);
    std::mutex mutex;
    std::size_t done = 0;
    for_each_index(named.size(), run.thread_count(), [&](std::size_t i) {
      objects[i] = explained(model, named[i], detail, look, limits);
      const std::lock_guard lock(mutex);
      bar.update("explaining names", ++done, named.size());
    });
  }
  write_file_atomically(report, classification_page(model_file.string(), model, objects, command_line()));
}

}  // namespace spincat::app
