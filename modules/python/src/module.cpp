#include "bindings.h"
#include "errors.h"

PYBIND11_MODULE(_core, m) {
  m.doc() = "The compiled part of graben; use the functions of the package graben instead.";
  m.attr("version") = GRABEN_VERSION;
  graben::python::translateErrors();
  graben::python::bindFiles(m);
  graben::python::bindHorizon(m);
  graben::python::bindMeasures(m);
  graben::python::bindModel(m);
  graben::python::bindSteps(m);
}
