// Measuring: rates over splits, and the splits themselves.
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "arrays.h"
#include "bindings.h"
#include "labelled_files.h"
#include "objects.h"
#include "settings.h"
#include "work.h"

namespace py = pybind11;

namespace spincat::python {
namespace {

namespace fs = std::filesystem;

// Python's class Evaluation: with what is needed to show it.
struct Measured {
  Evaluation result;
  Settings settings;
  EvaluateOptions options;
};

EvaluateOptions options_of(const py::dict& wanted) {
  EvaluateOptions options;
  options.leave_one_out = wanted["leave_one_out"].cast<bool>();
  options.splits = wanted["splits"].cast<int>();
  options.test_share = wanted["test_share"].cast<double>();
  options.split_seeds = wanted["seeds"].cast<std::vector<std::uint64_t>>();
  options.fewest_objects = wanted["fewest_objects"].cast<int>();
  options.test.form = test_form_named(wanted["test_as"].cast<std::string>());
  options.measure_confidence = wanted["confidence"].cast<bool>();
  options.validate();
  return options;
}

Measured measure(const Dataset& dataset, const std::optional<Dataset>& tested, const EvaluateOptions& options,
                 const Settings& settings, bool strict, int threads, const py::object& progress) {
  threads_of(threads);
  Evaluation result = run_work(progress, [&](Telling& telling) {
    const Execution execution = telling.execution(threads, strict);
    return tested ? evaluate_across(dataset, *tested, settings, options, execution)
                  : evaluate(dataset, settings, options, execution);
  });
  return {std::move(result), settings, options};
}

Measured evaluate_files(const std::vector<fs::path>& files, const std::vector<std::uint32_t>& labels,
                        const std::vector<std::string>& categories, const std::string& name, const py::dict& options,
                        const std::string& preset_name, const py::dict& chosen, int threads,
                        const py::object& progress) {
  return measure(labelled_files(files, labels, categories, name), std::nullopt, options_of(options),
                 settings_of(preset_name, chosen), true, threads, progress);
}

Measured evaluate_sources(const std::vector<fs::path>& sources, const DatasetOptions& data,
                          const std::vector<fs::path>& test, const py::dict& options, const std::string& preset_name,
                          const py::dict& chosen, int threads, const py::object& progress) {
  const EvaluateOptions wanted = options_of(options);
  const Settings settings = settings_of(preset_name, chosen);
  const auto [dataset, tested] = run_work(py::none(), [&](Telling&) {
    Dataset learned = read_dataset(sources, data);
    return std::pair(std::move(learned), test.empty() ? std::nullopt : std::optional(read_dataset(test)));
  });
  return measure(dataset, tested, wanted, settings, false, threads, progress);
}

py::array_t<std::uint32_t> confusion(const Measured& measured) {
  const auto n = static_cast<py::ssize_t>(measured.result.categories.size());
  py::array_t<std::uint32_t> matrix({n, n});
  std::uint32_t* to = matrix.mutable_data();
  for (const std::vector<std::uint32_t>& row : measured.result.confusion) {
    to = std::ranges::copy(row, to).out;
  }
  return matrix;
}

py::list tested(const Measured& measured) {
  const auto name = [&](std::uint32_t category) { return decoded(measured.result.categories[category]); };
  py::list list;
  for (const TestedObject& object : measured.result.tested) {
    py::list named;
    for (const std::uint32_t category : object.named) {
      named.append(name(category));
    }
    list.append(py::make_tuple(decoded(object.file.string()), name(object.category), named));
  }
  return list;
}

py::object json(const Measured& measured) {
  const std::string text = evaluation_json(measured.result, measured.settings, measured.options, {});
  return py::module_::import("json").attr("loads")(text);
}

std::string page(const Measured& measured) {
  return evaluation_page(measured.result, measured.settings, measured.options, {});
}

std::string text(const Measured& measured) {
  const Rate& rate = measured.result.mean_class_rate;
  return "<spincat.Evaluation: " +
         py::str("mean-class rate {:.3f} ± {:.3f}, overall rate {:.3f}, {} categories")
             .format(rate.mean, rate.deviation, measured.result.overall_rate.mean, measured.result.categories.size())
             .cast<std::string>() +
         ">";
}

py::list splits(const std::vector<std::uint32_t>& labels, int count, double test_share, std::uint64_t seed) {
  py::list result;
  for (Split& split : stratified_splits(labels, count, test_share, seed)) {
    result.append(py::make_tuple(array_of(std::move(split.train)), array_of(std::move(split.test))));
  }
  return result;
}

}  // namespace

void bind_evaluate(py::module_& module) {
  py::class_<Rate>(module, "Rate", "A rate over several splits, from 0 to 1.")
      .def_readonly("mean", &Rate::mean, "The mean over the splits.")
      .def_readonly("deviation", &Rate::deviation, "The sample standard deviation over the splits; 0 for a single one.")
      .def_property_readonly(
          "interval", [](const Rate& rate) { return py::make_tuple(rate.interval.low, rate.interval.high); },
          "Low and high end of the 95 % interval.")
      .def("__repr__", [](const Rate& rate) {
        return py::str("<spincat.Rate: {:.3f} ± {:.3f}, 95 % {:.3f} to {:.3f}>")
            .format(rate.mean, rate.deviation, rate.interval.low, rate.interval.high);
      });
  py::class_<Measured>(module, "Evaluation", "How often names were right; evaluate makes it.")
      .def_property_readonly(
          "categories", [](const Measured& m) { return m.result.categories; }, "The n categories.")
      .def_property_readonly(
          "mean_class_rate", [](const Measured& m) { return m.result.mean_class_rate; },
          "The mean of the confusion matrix's diagonal, its rows as shares: balanced accuracy.")
      .def_property_readonly(
          "overall_rate", [](const Measured& m) { return m.result.overall_rate; },
          "Right names over all names: accuracy.")
      .def_property_readonly(
          "category_rates", [](const Measured& m) { return m.result.category_rates; },
          "A Rate for each category: its recall.")
      .def_property_readonly("confusion", &confusion,
                             "n x n uint32, added up over the splits: rows are the truth, columns the names.")
      .def_property_readonly(
          "tested", &tested,
          "For each object that could be tested: its file, its category, and the name that each split "
          "which tested\nit gave.")
      .def_property_readonly(
          "skipped",
          [](const Measured& m) {
            py::list list;
            for (const SkippedObject& object : m.result.skipped) {
              list.append(py::make_tuple(decoded(object.file.string()), decoded(object.reason)));
            }
            return list;
          },
          "File and reason of each object that could not be used.")
      .def("info", &json, "Everything as a dict: what `spincat evaluate --json` prints.")
      .def("html", &page, "The report as a page of HTML that needs nothing else: what `--report` writes.")
      .def("__repr__", &text)
      .def("_repr_html_", [](const Measured& measured) { return framed(page(measured)); });
  module.def("evaluate_files", &evaluate_files);
  module.def("evaluate_sources", &evaluate_sources);
  module.def("splits", &splits);
}

}  // namespace spincat::python
