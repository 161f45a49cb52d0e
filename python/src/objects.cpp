#include "objects.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>

#include "arrays.h"
#include "bindings.h"
#include "work.h"

namespace py = pybind11;

namespace spincat::python {
namespace {

namespace fs = std::filesystem;

const std::vector<Vec3>& points_of(const Object& object) {
  if (const auto* mesh = std::get_if<Mesh>(&object)) {
    return mesh->vertices;
  }
  return std::get<PointCloud>(object).points;
}

py::ssize_t size_of(const auto& vector) {
  return static_cast<py::ssize_t>(vector.size());
}

std::vector<Triangle> triangles(const py::handle& given, std::size_t points) {
  const py::array array = any_array(given, "faces", "an array of shape (M, 3)");
  if (array.ndim() != 2 || array.shape(1) != 3) {
    throw InputError("faces: expected an array of shape (M, 3), found " + shape_text(array));
  }
  if (array.dtype().kind() == 'f') {
    throw InputError("faces: expected whole numbers, found values of type " +
                     py::str(py::object(array.dtype())).cast<std::string>());
  }
  check_memory(static_cast<double>(array.size()) * sizeof(std::int64_t), "faces");
  const py::array_t<std::int64_t, py::array::c_style | py::array::forcecast> indices(array);
  const auto at = indices.unchecked<2>();
  std::vector<Triangle> result(static_cast<std::size_t>(at.shape(0)));
  for (py::ssize_t f = 0; f < at.shape(0); ++f) {
    for (py::ssize_t corner = 0; corner < 3; ++corner) {
      const std::int64_t index = at(f, corner);
      if (index < 0 || static_cast<std::uint64_t>(index) >= points) {
        throw InputError("faces: row " + std::to_string(f) + " names point " + std::to_string(index) +
                         "; points are 0 to " + std::to_string(points - 1));
      }
      result[static_cast<std::size_t>(f)][static_cast<std::size_t>(corner)] = static_cast<std::uint32_t>(index);
    }
  }
  return result;
}

std::vector<Vec3> normals_of(const py::handle& given, std::size_t points) {
  const Matrix matrix(given, "normals", 3);
  if (matrix.rows() != points) {
    throw InputError("normals: expected one for each of " + std::to_string(points) + " points, found " +
                     std::to_string(matrix.rows()));
  }
  std::vector<Vec3> normals(points);
  for (std::size_t i = 0; i < points; ++i) {
    normals[i] = matrix.vector(i);
  }
  return normals;
}

Vec3 position_of(const py::handle& given, const std::string& name) {
  const py::array array = any_array(given, name, "three numbers");
  if (array.ndim() != 1 || array.shape(0) != 3) {
    throw InputError(name + ": expected three numbers, found " + shape_text(array));
  }
  const py::array_t<double, py::array::c_style | py::array::forcecast> numbers(array);
  const Vec3 position(numbers.at(0), numbers.at(1), numbers.at(2));
  if (!position.allFinite()) {
    throw InputError(name + ": is not finite");
  }
  return position;
}

Shape make_shape(const py::object& points, const py::object& faces, const py::object& normals,
                 const py::object& sensor) {
  std::vector<Vec3> positions = finite_points(points, "points");
  if (!faces.is_none()) {
    std::vector<Triangle> corners = triangles(faces, positions.size());
    if (!corners.empty()) {  // as in files: points without faces are a cloud
      if (!normals.is_none() || !sensor.is_none()) {
        throw InputError("normals and sensor are of point clouds; those of a mesh follow from its faces");
      }
      return {std::make_shared<const Object>(Mesh{std::move(positions), std::move(corners)}), {}};
    }
  }
  PointCloud cloud;
  cloud.normals = normals.is_none() ? std::vector<Vec3>() : normals_of(normals, positions.size());
  cloud.points = std::move(positions);
  if (!sensor.is_none()) {
    cloud.sensor = position_of(sensor, "sensor");
  }
  return {std::make_shared<const Object>(std::move(cloud)), {}};
}

py::object vectors(const std::vector<Vec3>& from, const py::object& owner) {
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  return view_of(from.empty() ? nullptr : from.front().data(), {size_of(from), 3}, owner);
}

py::object points(const py::object& self) {
  return vectors(points_of(*self.cast<const Shape&>().object), self);
}

py::object faces(const py::object& self) {
  const auto* mesh = std::get_if<Mesh>(self.cast<const Shape&>().object.get());
  if (mesh == nullptr) {
    return py::none();
  }
  return view_of(mesh->triangles.front().data(), {size_of(mesh->triangles), 3}, self);
}

py::object normals(const py::object& self) {
  const auto* cloud = std::get_if<PointCloud>(self.cast<const Shape&>().object.get());
  return cloud == nullptr || cloud->normals.empty() ? py::object(py::none()) : vectors(cloud->normals, self);
}

py::object sensor(const Shape& shape) {
  const auto* cloud = std::get_if<PointCloud>(shape.object.get());
  if (cloud == nullptr || !cloud->sensor) {
    return py::none();
  }
  const Vec3& at = *cloud->sensor;
  return array_of<double>({at.x(), at.y(), at.z()});
}

std::string kind(const Shape& shape) {
  return std::holds_alternative<Mesh>(*shape.object) ? "mesh" : "cloud";
}

std::string text(const Shape& shape) {
  std::string result = "<spincat.Object: ";
  if (const auto* mesh = std::get_if<Mesh>(shape.object.get())) {
    result += "mesh of " + std::to_string(mesh->vertices.size()) + " points and " +
              std::to_string(mesh->triangles.size()) + " faces";
  } else {
    const auto& cloud = std::get<PointCloud>(*shape.object);
    result +=
        "cloud of " + std::to_string(cloud.points.size()) + (cloud.normals.empty() ? " points" : " oriented points");
  }
  return result + (shape.file.empty() ? "" : ", " + shape.file.filename().string()) + ">";
}

py::object info(const Shape& shape) {
  const std::string json = object_json(shape.file.string(), *shape.object);
  return py::module_::import("json").attr("loads")(json);
}

std::string page(const Shape& shape) {
  const std::string name = shape.file.empty() ? "Object" : shape.file.filename().string();
  return framed(run_work(py::none(), [&](Telling&) { return object_page(name, *shape.object, preset("default")); }));
}

py::tuple arrays_of(const py::object& self) {
  return py::make_tuple(py::type::of(self),
                        py::make_tuple(points(self), faces(self), normals(self), sensor(self.cast<const Shape&>())));
}

Shape read(const fs::path& file, const ReadLimits& limits) {
  return {std::make_shared<const Object>(read_object(file, limits)), file};
}

Shape read_limited(const fs::path& file, std::size_t max_points, std::size_t max_triangles, std::size_t max_growth) {
  return run_work(py::none(), [&](Telling&) { return read(file, {max_points, max_triangles, max_growth}); });
}

py::object normals_of_points(const py::object& given, int neighbours, const py::object& towards) {
  const std::vector<Vec3> from = finite_points(given, "points");
  const std::optional<Vec3> sensor = towards.is_none() ? std::nullopt : std::optional(position_of(towards, "towards"));
  const std::vector<Vec3> found =
      run_work(py::none(), [&](Telling&) { return estimate_normals(from, neighbours, sensor); });
  py::array_t<double> result({size_of(found), py::ssize_t{3}});
  std::copy_n(found.front().data(), 3 * found.size(), result.mutable_data());
  return result;
}

}  // namespace

Item item_of(const py::handle& given, const std::string& name) {
  if (py::isinstance<Shape>(given)) {
    return given.cast<Shape>();
  }
  if (py::isinstance<py::str>(given) || py::isinstance<py::bytes>(given) || py::hasattr(given, "__fspath__")) {
    return given.cast<fs::path>();
  }
  throw InputError(name + ": expected an Object or the name of a file, found " +
                   py::str(py::type::handle_of(given).attr("__name__")).cast<std::string>());
}

std::vector<Item> items_of(const py::handle& given, const std::string& name) {
  const bool is_one = py::isinstance<Shape>(given) || py::isinstance<py::str>(given) ||
                      py::isinstance<py::bytes>(given) || py::hasattr(given, "__fspath__");
  if (is_one || !py::hasattr(given, "__iter__")) {
    throw InputError(name + ": expected a list of Objects or of file names, found " +
                     py::str(py::type::handle_of(given).attr("__name__")).cast<std::string>());
  }
  std::vector<Item> items;
  for (const py::handle& one : py::reinterpret_borrow<py::object>(given)) {
    items.push_back(item_of(one, name + "[" + std::to_string(items.size()) + "]"));
  }
  return items;
}

Shape shape_of(const Item& item) {
  if (const auto* shape = std::get_if<Shape>(&item)) {
    return *shape;
  }
  return read(std::get<fs::path>(item), {});
}

std::string name_of(const Item& item, std::size_t index) {
  const auto* file = std::get_if<fs::path>(&item);
  return file != nullptr ? file->string() : "objects[" + std::to_string(index) + "]";
}

std::string framed(const std::string& page) {
  std::string result = "<iframe style=\"width:100%;height:640px;border:0\" sandbox=\"allow-scripts\" srcdoc=\"";
  result.reserve(page.size() + page.size() / 8);
  for (const char c : page) {
    if (c == '&') {
      result += "&amp;";
    } else if (c == '"') {
      result += "&quot;";
    } else {
      result += c;
    }
  }
  return result + "\"></iframe>";
}

void bind_objects(py::module_& module) {
  py::class_<Shape>(
      module, "Object",
      "A mesh or a point cloud, never changed: N x 3 `points`, and M x 3 `faces` (indices of points) of a "
      "mesh, or N x 3\n`normals` and the place of the `sensor` of a cloud. In any unit; arrays are copied "
      "once, on their way in. Raises\nInputError for other shapes, points that are not finite, and where "
      "there is no point.\n\n"
      ">>> import numpy as np, spincat\n"
      ">>> spincat.Object(np.eye(3), faces=[[0, 1, 2]])\n"
      "<spincat.Object: mesh of 3 points and 1 faces>\n")
      .def(py::init(&make_shape), py::arg("points"), py::arg("faces") = py::none(), py::arg("normals") = py::none(),
           py::arg("sensor") = py::none())
      .def_property_readonly("points", &points, "N x 3 positions, float64, read-only and not copied.")
      .def_property_readonly("faces", &faces,
                             "M x 3 indices of points, uint32, counter-clockwise from the front; None of a cloud.")
      .def_property_readonly("normals", &normals,
                             "N x 3 normals of a cloud, of any length, as they were given; None where there are none.")
      .def_property_readonly("sensor", &sensor, "Where a cloud was seen from, where that is known; else None.")
      .def_property_readonly("kind", &kind, "'mesh' or 'cloud'.")
      .def_property_readonly(
          "file", [](const Shape& shape) { return decoded(shape.file.string()); },
          "The file that it was read from; '' where it was made of arrays.")
      .def("info", &info, "Size, area, resolution and defects as a dict: what `spincat info --json` says of a file.")
      .def("__len__", [](const Shape& shape) { return points_of(*shape.object).size(); })
      .def("__repr__", [](const Shape& shape) { return decoded(text(shape)); })
      .def("_repr_html_", &page)
      .def("__reduce__", &arrays_of);
  module.def("read", &read_limited);
  module.def("write", [](const fs::path& file, const Shape& shape) {
    run_work(py::none(), [&](Telling&) {
      write_object(file, *shape.object);
      return true;
    });
  });
  module.def("estimate_normals", &normals_of_points);
}

}  // namespace spincat::python
