#pragma once

#include <pybind11/pybind11.h>

namespace graben::python {

/// What graben throws becomes the exceptions of graben.errors, wrong options ValueError.
void translateErrors();

} // namespace graben::python
