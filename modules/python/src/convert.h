#pragma once

#include "graben/core/types.h"
#include "graben/io/fault_reader.h"
#include "graben/io/pick_set.h"
#include "graben/mesh/triangle_mesh.h"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <string>
#include <vector>

/// numpy arrays and graben's types. Shapes are checked before, in Python; what leaves graben is handed over, not copied.
namespace graben::python {

namespace py = pybind11;

using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Floats = py::array_t<float, py::array::c_style | py::array::forcecast>;
using Indices = py::array_t<Index, py::array::c_style | py::array::forcecast>;

/// An array of rows that keeps the vector alive. \param[in] columns numbers to an item; 0: the array has one dimension
template <typename Number, typename Item>
py::array handOver(std::vector<Item>&& items, std::size_t columns) {
  static_assert(sizeof(Item) % sizeof(Number) == 0, "an item is a row of numbers");
  auto* kept = new std::vector<Item>(std::move(items));
  const py::capsule owner(kept, [](void* vector) { delete static_cast<std::vector<Item>*>(vector); });
  std::vector<py::ssize_t> shape = {static_cast<py::ssize_t>(kept->size())};
  if (columns > 0)
    shape.push_back(static_cast<py::ssize_t>(columns));
  if (kept->empty())
    return py::array(py::dtype::of<Number>(), shape);
  return py::array(py::dtype::of<Number>(), shape, reinterpret_cast<const Number*>(kept->data()), owner);
}

inline py::array arrayOf(Points&& points) { return handOver<double>(std::move(points), 3); }
inline py::array arrayOf(std::vector<Triangle>&& triangles) { return handOver<Index>(std::move(triangles), 3); }

Points pointsOf(const Doubles& rows);
std::vector<Triangle> trianglesOf(const Indices& rows);

const char* wordOf(ZPositive way);
ZPositive wayOf(const std::string& word);

/// vertices, triangles, normals, pieces and fields; None where there are none.
py::dict dictOf(TriangleMesh&& mesh);
TriangleMesh meshOf(const py::dict& mesh);

py::dict dictOf(PickSet&& picks);
PickSet picksOf(const py::dict& picks);

py::dict dictOf(FaultInput&& fault);
FaultInput faultOf(const py::dict& fault);
std::vector<FaultInput> faultsOf(const py::list& faults);

} // namespace graben::python
