// The vote on one object, and where on the object it comes from.
#include <pybind11/stl.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "arrays.h"
#include "bindings.h"
#include "model.h"
#include "work.h"

namespace py = pybind11;

namespace spincat::python {
namespace {

std::string name(const NamedItem& ballot) {
  return ballot.is_unknown() ? "unknown" : ballot.winner();
}

const std::string& runner_up(const NamedItem& ballot) {
  return ballot.model.categories()[ballot.answer.ballot.runner_up];
}

py::dict votes(const NamedItem& ballot) {
  py::dict result;
  for (std::size_t c = 0; c < ballot.model.categories().size(); ++c) {
    result[py::str(ballot.model.categories()[c])] = ballot.answer.ballot.count[c];
  }
  return result;
}

py::array_t<float> margins(const NamedItem& ballot) {
  const auto n = static_cast<py::ssize_t>(ballot.model.categories().size());
  py::array_t<float> result({n, n});
  std::fill_n(result.mutable_data(), n * n, 0.0F);
  auto at = result.mutable_unchecked<2>();
  for (const Vote& vote : ballot.answer.ballot.votes) {
    at(vote.category_a, vote.category_b) = vote.margin;
    at(vote.category_b, vote.category_a) = -vote.margin;
  }
  return result;
}

std::string file(const NamedItem& ballot) {
  const auto* path = std::get_if<std::filesystem::path>(&ballot.item);
  return path != nullptr ? path->string() : std::get<Shape>(ballot.item).file.string();
}

std::string short_number(double value) {
  return py::str("{:.2f}").format(value).cast<std::string>();
}

std::string text(const NamedItem& ballot) {
  std::string result = "<spincat.Ballot: " + name(ballot) + ", confidence " + short_number(ballot.answer.confidence);
  if (ballot.is_unknown()) {
    result += ", known " + short_number(ballot.answer.known) + ", best guess " + ballot.winner();
  }
  return result + ", runner-up " + runner_up(ballot) + ">";
}

std::string page(const NamedItem& ballot) {
  const std::string title = file(ballot).empty() ? "Object" : file(ballot);
  const std::string model = ballot.model.file().empty() ? "a model in memory" : ballot.model.file().string();
  return framed(run_work(py::none(), [&](Telling&) {
    const std::vector<NamedObject> shown = {{title, *shape_of(ballot.item).object, ballot.answer}};
    return classification_page(model, ballot.model, shown);
  }));
}

// The spin points of a part in the unit of the object, and what they say.
py::dict part_of(const PartEvidence& evidence) {
  const PreparedObject& prepared = evidence.prepared.preparation.object;
  const std::size_t count = evidence.of_point.size();
  py::array_t<double> points({static_cast<py::ssize_t>(count), py::ssize_t{3}});
  py::array_t<float> axes({static_cast<py::ssize_t>(count), py::ssize_t{3}});
  for (std::size_t k = 0; k < count; ++k) {
    const Vec3 at = prepared.spin_points.position(k).cast<double>() / prepared.scale + prepared.centre;
    const Eigen::Vector3f axis = prepared.spin_points.normal(k);
    std::copy_n(at.data(), 3, points.mutable_data() + 3 * k);
    std::copy_n(axis.data(), 3, axes.mutable_data() + 3 * k);
  }
  py::dict part;
  part["axes"] = py::str(std::string(name_of(evidence.prepared.axes)));
  part["points"] = points;
  part["directions"] = axes;
  part["contributions"] = array_of(evidence.of_point);
  return part;
}

py::dict explain_ballot(const NamedItem& ballot) {
  const Evidence evidence = run_work(
      py::none(), [&](Telling&) { return explain(ballot.model, *shape_of(ballot.item).object, ballot.answer.ballot); });
  py::list parts;
  for (const PartEvidence& part : evidence.parts) {
    parts.append(part_of(part));
  }
  py::dict result;
  result["winner"] = ballot.model.categories()[evidence.winner];
  result["runner_up"] = ballot.model.categories()[evidence.runner_up];
  result["margin"] = evidence.margin;
  result["adds_up"] = evidence.kind == EvidenceKind::shares;
  result["parts"] = parts;
  return result;
}

}  // namespace

void bind_ballot(py::module_& module) {
  py::class_<NamedItem>(
      module, "Ballot",
      "The vote on one object: what every judge said, and what came of it. Classifier.ballots makes them.")
      .def_property_readonly("name", &name, "The category, or 'unknown' where the object is less known than `reject`.")
      .def_property_readonly(
          "best_guess", [](const NamedItem& ballot) { return ballot.winner(); },
          "The category with the most votes, however known the object is.")
      .def_property_readonly("runner_up", &runner_up, "The best of the other categories.")
      .def_property_readonly(
          "confidence", [](const NamedItem& ballot) { return ballot.answer.confidence; },
          "How likely the best guess is right, in (0, 1), if the object is of one of the categories.")
      .def_property_readonly(
          "known", [](const NamedItem& ballot) { return ballot.answer.known; },
          "How likely the object is of one of the categories, in (0, 1]; 1 where the model tells no strangers.")
      .def_property_readonly("unknown", &NamedItem::is_unknown, "Whether the name is 'unknown'.")
      .def_property_readonly(
          "categories", [](const NamedItem& ballot) { return ballot.model.categories(); },
          "The n categories, in the order of `margins`.")
      .def_property_readonly("votes", &votes, "Votes for each category, as a dict; n - 1 at most.")
      .def_property_readonly(
          "margins", &margins,
          "n x n float32: what the judge of categories a and b says. Above 0 it speaks for a, and 1 is "
          "the edge of\nits margin; [b, a] is -[a, b].")
      .def_property_readonly(
          "margin_sums", [](const NamedItem& ballot) { return array_of(ballot.answer.ballot.margin_sum); },
          "n float32: the margins of each category's judges in its favour, added up.")
      .def_property_readonly(
          "kind_mismatch", [](const NamedItem& ballot) { return ballot.answer.kind_mismatch; },
          "Why the judges were not trained for such an object; mostly ''.")
      .def_property_readonly(
          "file", [](const NamedItem& ballot) { return decoded(file(ballot)); },
          "The object's file, '' where it has none.")
      .def("explain", &explain_ballot, "What Classifier.explain tells, as a dict.")
      .def("__repr__", &text)
      .def("_repr_html_", &page);
}

}  // namespace spincat::python
