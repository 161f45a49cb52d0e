// Models: learned from files, kept in files, and the answers that they give.
#include "model.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "bindings.h"
#include "labelled_files.h"
#include "settings.h"
#include "work.h"

namespace py = pybind11;

namespace spincat::python {
namespace {

namespace fs = std::filesystem;

py::list list_of(const std::vector<SkippedObject>& skipped) {
  py::list result;
  for (const SkippedObject& object : skipped) {
    result.append(py::make_tuple(decoded(object.file.string()), decoded(object.reason)));
  }
  return result;
}

py::tuple train_on(const Dataset& dataset, const Settings& settings, bool strict, int threads,
                   const py::object& progress) {
  threads_of(threads);
  TrainResult result = run_work(
      progress, [&](Telling& telling) { return train(dataset, settings, telling.execution(threads, strict)); });
  return py::make_tuple(std::move(result.model), list_of(result.skipped));
}

py::tuple train_files(const std::vector<fs::path>& files, const std::vector<std::uint32_t>& labels,
                      const std::vector<std::string>& categories, const std::string& name,
                      const std::string& preset_name, const py::dict& chosen, int threads, const py::object& progress) {
  return train_on(labelled_files(files, labels, categories, name), settings_of(preset_name, chosen), true, threads,
                  progress);
}

py::tuple train_sources(const std::vector<fs::path>& sources, const DatasetOptions& options, bool all, bool strict,
                        const std::string& preset_name, const py::dict& chosen, int threads,
                        const py::object& progress) {
  const Settings settings = settings_of(preset_name, chosen);
  Dataset dataset = run_work(py::none(), [&](Telling&) { return read_dataset(sources, options); });
  return train_on(all ? dataset : training_part(dataset), settings, strict, threads, progress);
}

// Throws the InputError of the first item that has no answer.
std::vector<NamedItem> classify_items(const Model& model, const py::object& objects, double reject, int threads,
                                      const py::object& progress) {
  threads_of(threads);
  constexpr Range kReject{0.0, 1.0};
  check_range("reject", reject, kReject);
  const std::vector<Item> items = items_of(objects, "objects");
  std::vector<Classification> answers(items.size());
  run_on_thread(progress, [&](Telling& telling) {
    share_out(items.size(), threads, "naming objects", telling, [&](std::size_t i) {
      answers[i] = naming_item(items[i], i, [&] { return classify(model, *shape_of(items[i]).object); });
    });
  });
  std::vector<NamedItem> named;
  for (std::size_t i = 0; i < items.size(); ++i) {
    named.push_back({model, items[i], std::move(answers[i]), reject});
  }
  return named;
}

std::string text(const Model& model) {
  return "<spincat.Model: " + std::to_string(model.categories().size()) + " categories, trained on " + model.dataset() +
         ">";
}

}  // namespace

void bind_model(py::module_& module) {
  py::class_<DatasetOptions>(module, "DatasetOptions")
      .def(py::init(
          [](const fs::path& models, const fs::path& map, const fs::path& others, const fs::path& others_models) {
            return DatasetOptions{models, map, others, others_models, {}};
          }));
  py::class_<Model>(module, "Model")
      .def_property_readonly("categories", [](const Model& model) { return model.categories(); })
      .def_property_readonly("object_counts", [](const Model& model) { return model.object_counts(); })
      .def_property_readonly("settings", [](const Model& model) { return dict_of(model.settings()); })
      .def_property_readonly("dataset", [](const Model& model) { return model.dataset(); })
      .def_property_readonly("made_by", [](const Model& model) { return model.made_by(); })
      .def_property_readonly("feature_length", [](const Model& model) { return model.feature_length(); })
      .def_property_readonly("least_known", [](const Model& model) { return model.least_known(); })
      .def("write",
           [](const Model& model, const fs::path& file) {
             run_on_thread(py::none(), [&](Telling&) { write_model(file, model); });
           })
      .def("classify", &classify_items)
      .def("__repr__", &text);
  module.def("read_model",
             [](const fs::path& file) { return run_work(py::none(), [&](Telling&) { return read_model(file); }); });
  module.def("train_files", &train_files);
  module.def("train_sources", &train_sources);
}

}  // namespace spincat::python
