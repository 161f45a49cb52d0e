// What the module _spincat is put together from: one function a subject, each in the file of its name.
#pragma once

#include <pybind11/pybind11.h>

namespace spincat::python {

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
