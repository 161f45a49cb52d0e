// InputError and RunError as Python's exceptions: each knows the file and the problem besides the whole line.
#include <spincat/spincat.h>

#include <exception>
#include <string>

#include "bindings.h"

namespace py = pybind11;

namespace spincat::python {
namespace {

// They live as long as the process, as the module does.
PyObject* input_error = nullptr;
PyObject* run_error = nullptr;

PyObject* make_type(py::module_& module, const char* name, PyObject* base, const char* doc) {
  const std::string full = std::string("spincat.") + name;
  const auto members = py::dict(py::arg("file") = "", py::arg("problem") = "");
  PyObject* type = PyErr_NewExceptionWithDoc(full.c_str(), doc, base, members.ptr());
  if (type == nullptr) {
    throw py::error_already_set();
  }
  module.attr(name) = py::handle(type);
  return type;
}

void set_error(PyObject* type, const Error& error) {
  const py::object exception = py::handle(type)(decoded(error.what()));
  exception.attr("file") = decoded(error.file());
  exception.attr("problem") = decoded(error.problem());
  PyErr_SetObject(type, exception.ptr());
}

void translate(std::exception_ptr thrown) {
  try {
    if (thrown) {
      std::rethrow_exception(thrown);
    }
  } catch (const InputError& error) {
    set_error(input_error, error);
  } catch (const RunError& error) {
    set_error(run_error, error);
  }
}

}  // namespace

py::object decoded(const std::string& bytes) {
  return py::reinterpret_steal<py::object>(
      PyUnicode_DecodeFSDefaultAndSize(bytes.data(), static_cast<Py_ssize_t>(bytes.size())));
}

void bind_errors(py::module_& module) {
  input_error =
      make_type(module, "InputError", PyExc_ValueError,
                "What was handed in is bad or was used wrongly: a damaged file, a setting out of its range, an "
                "array of\nanother shape. `file` is the file's name, where one is known, and `problem` the "
                "line without it.");
  run_error = make_type(module, "RunError", PyExc_RuntimeError,
                        "The input is fine but the work could not be done: disk full, not enough memory. `file` and "
                        "`problem` as in\nInputError.");
  py::register_exception_translator(translate);
}

}  // namespace spincat::python
