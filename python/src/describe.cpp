// Objects to feature vectors, and the points that these are made of.
#include <pybind11/stl.h>

#include <algorithm>
#include <string>
#include <vector>

#include "arrays.h"
#include "bindings.h"
#include "objects.h"
#include "settings.h"
#include "work.h"

namespace py = pybind11;

namespace spincat::python {
namespace {

py::array_t<float> rows_of(const std::vector<std::vector<float>>& features, std::size_t length) {
  check_memory(static_cast<double>(features.size()) * static_cast<double>(length * sizeof(float)), "features");
  py::array_t<float> rows({static_cast<py::ssize_t>(features.size()), static_cast<py::ssize_t>(length)});
  float* to = rows.mutable_data();
  for (const std::vector<float>& row : features) {
    to = std::ranges::copy(row, to).out;
  }
  return rows;
}

py::array_t<float> describe_items(const py::object& objects, const std::string& preset_name, const py::dict& chosen,
                                  int threads, const py::object& progress) {
  threads_of(threads);
  const Settings settings = settings_of(preset_name, chosen, SettingStage::features);
  const std::vector<Item> items = items_of(objects, "objects");
  if (items.empty()) {
    throw InputError("objects: expected one object or more, found none");
  }
  std::vector<std::vector<float>> features(items.size());
  run_on_thread(progress, [&](Telling& telling) {
    share_out(items.size(), threads, "describing objects", telling, [&](std::size_t i) {
      features[i] = naming_item(items[i], i, [&] { return describe(*shape_of(items[i]).object, settings).values; });
    });
  });
  const std::size_t length = features[0].size();
  const auto other = std::ranges::find_if(features, [&](const auto& row) { return row.size() != length; });
  if (other != features.end()) {
    const auto i = static_cast<std::size_t>(other - features.begin());
    throw InputError(name_of(items[i], i), "gives " + std::to_string(other->size()) + " features where others give " +
                                               std::to_string(length));
  }
  return rows_of(features, length);
}

// K x 6: positions and normals in the prepared unit.
py::array_t<float> table_of(const OrientedPoints& points) {
  py::array_t<float> table({static_cast<py::ssize_t>(points.size()), py::ssize_t{6}});
  auto at = table.mutable_unchecked<2>();
  for (py::ssize_t i = 0; i < at.shape(0); ++i) {
    const auto k = static_cast<std::size_t>(i);
    const Eigen::Vector3f position = points.position(k);
    const Eigen::Vector3f normal = points.normal(k);
    for (int axis = 0; axis < 3; ++axis) {
      at(i, axis) = position[axis];
      at(i, 3 + axis) = normal[axis];
    }
  }
  return table;
}

py::dict prepare_item(const py::object& object, const std::string& preset_name, const py::dict& chosen) {
  const Settings settings = settings_of(preset_name, chosen, SettingStage::images);
  const Item item = item_of(object, "object");
  const Preparation made = run_work(py::none(), [&](Telling&) {
    return naming_item(item, 0, [&] { return prepare_object(*shape_of(item).object, settings); });
  });
  const Vec3& centre = made.object.centre;
  py::dict result;
  result["surface"] = table_of(made.object.surface);
  result["keypoints"] = table_of(made.object.spin_points);
  result["scale"] = made.object.scale;
  result["centre"] = array_of<double>({centre.x(), centre.y(), centre.z()});
  result["bin_size"] = made.params.bin_size;
  return result;
}

}  // namespace

void bind_describe(py::module_& module) {
  module.def("describe", &describe_items);
  module.def("prepare", &prepare_item);
}

}  // namespace spincat::python
