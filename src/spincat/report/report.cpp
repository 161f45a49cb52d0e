#include "spincat/report/report.h"

#include "spincat/classify/evidence.h"
#include "spincat/describe/describe.h"
#include "spincat/prepare/facts.h"
#include "spincat/report/json.h"
#include "spincat/report/object_page.h"

namespace spincat {

std::string object_json(const std::string& file, const Object& object) {
  return object_json(file, facts_of(object));
}

std::string classification_page(const std::string& model_file, const Model& model, std::span<const NamedObject> objects,
                                const std::vector<std::string>& command) {
  const PageDetail detail = page_detail(objects.size());
  std::vector<PageObject> shown;
  for (const NamedObject& named : objects) {
    const Evidence evidence = explain(model, named.object, named.classification.ballot);
    shown.push_back(page_object(named.file, named.classification, model, named.object, evidence, detail));
  }
  return classification_page(model_file, model, shown, command);
}

std::string object_page(const std::string& file, const Object& object, const Settings& settings,
                        const std::vector<std::string>& command) {
  return object_page(file, object, facts_of(object), prepare_object(object, settings), settings, command);
}

}  // namespace spincat
