// The parts of the extension module; each adds its classes and functions.
#pragma once

#include <pybind11/pybind11.h>

namespace hysteron::python {

namespace py = pybind11;

void bind_fabric(py::module_& module);
void bind_law(py::module_& module);
void bind_scene(py::module_& module);
void bind_simulation(py::module_& module);
void bind_pictures(py::module_& module);
void bind_fit(py::module_& module);

}  // namespace hysteron::python
