// What the module _spincat is put together from: one function a subject, each in the file of its name.
#pragma once

#include <pybind11/pybind11.h>

#include <string>

namespace spincat::python {

// Text of the library may hold names of files and folders, whose bytes need not be UTF-8: Python's way to keep them.
pybind11::object decoded(const std::string& bytes);

void bind_errors(pybind11::module_& module);
void bind_settings(pybind11::module_& module);
void bind_objects(pybind11::module_& module);
void bind_spin_images(pybind11::module_& module);
void bind_describe(pybind11::module_& module);
void bind_model(pybind11::module_& module);
void bind_ballot(pybind11::module_& module);
void bind_evaluate(pybind11::module_& module);
void bind_camera(pybind11::module_& module);

}  // namespace spincat::python
