#pragma once

#include <pybind11/pybind11.h>

/// What graben._core is made of; graben/_core.pyi says what each function takes and gives.
namespace graben::python {

void bindFiles(pybind11::module_& m);
void bindHorizon(pybind11::module_& m);
void bindMeasures(pybind11::module_& m);
void bindModel(pybind11::module_& m);
void bindSteps(pybind11::module_& m);

} // namespace graben::python
