#include "arrays.h"

#include <unistd.h>

#include <utility>

namespace py = pybind11;

namespace spincat::python {
namespace {

bool holds_numbers(const py::array& array) {
  const char kind = array.dtype().kind();
  return kind == 'f' || kind == 'i' || kind == 'u';
}

}  // namespace

std::string shape_text(const py::array& array) {
  return "an array of shape " + py::str(array.attr("shape")).cast<std::string>();
}

py::array any_array(const py::handle& given, const std::string& name, const std::string& expected) {
  py::array array = given.is_none() ? py::array() : py::array::ensure(given);
  if (!array || given.is_none()) {
    throw InputError(name + ": expected " + expected + ", found " +
                     py::str(py::type::handle_of(given).attr("__name__")).cast<std::string>());
  }
  if (!holds_numbers(array)) {
    throw InputError(name + ": expected numbers, found values of type " +
                     py::str(py::object(array.dtype())).cast<std::string>());
  }
  return array;
}

Matrix::Matrix(const py::handle& given, const std::string& name, std::size_t columns) {
  const std::string expected = "an array of shape (N, " + std::to_string(columns) + ")";
  array_ = any_array(given, name, expected);
  if (array_.ndim() != 2 || array_.shape(1) != static_cast<py::ssize_t>(columns)) {
    throw InputError(name + ": expected " + expected + ", found " + shape_text(array_));
  }
  single_ = py::isinstance<py::array_t<float>>(array_);
  if (!single_ && !py::isinstance<py::array_t<double>>(array_)) {
    check_memory(static_cast<double>(array_.size()) * sizeof(double), name);
    array_ = py::array_t<double>(array_);
  }
  data_ = static_cast<const char*>(array_.data());
  rows_ = static_cast<std::size_t>(array_.shape(0));
  row_stride_ = array_.strides(0);
  column_stride_ = array_.strides(1);
}

std::vector<Vec3> finite_points(const py::handle& array, const std::string& name) {
  const Matrix matrix(array, name, 3);
  if (matrix.rows() == 0) {
    throw InputError(name + ": expected one point or more, found none");
  }
  check_memory(static_cast<double>(matrix.rows()) * sizeof(Vec3), name);
  std::vector<Vec3> points(matrix.rows());
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i] = matrix.vector(i);
    if (!points[i].allFinite()) {
      throw InputError(name + ": row " + std::to_string(i) + " is not finite; leave such points out");
    }
  }
  return points;
}

void check_memory(double bytes, const std::string& what) {
  const double all = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  if (bytes > all) {
    constexpr double kGigabyte = 1e9;
    const auto gigabytes = [](double of) { return std::to_string(static_cast<long long>(of / kGigabyte)) + " GB"; };
    throw RunError(what + ": would take " + gigabytes(bytes) + ", and the machine has " + gigabytes(all));
  }
}

}  // namespace spincat::python
