#include "convert.h"

#include <cstring>
#include <stdexcept>

namespace graben::python {
namespace {

template <typename Item, typename Array>
std::vector<Item> copied(const Array& rows) {
  std::vector<Item> items(static_cast<std::size_t>(rows.shape(0)));
  if (static_cast<std::size_t>(rows.nbytes()) != items.size() * sizeof(Item))
    throw std::invalid_argument("an array of this shape was not expected here");
  if (!items.empty())
    std::memcpy(static_cast<void*>(items.data()), rows.data(), items.size() * sizeof(Item));
  return items;
}

py::list listOf(std::vector<FaultStick>&& sticks) {
  py::list list;
  for (FaultStick& stick : sticks)
    list.append(arrayOf(std::move(stick.points)));
  return list;
}

std::vector<FaultStick> sticksOf(const py::list& list) {
  std::vector<FaultStick> sticks;
  for (const py::handle& stick : list)
    sticks.push_back({pointsOf(stick.cast<Doubles>())});
  return sticks;
}

} // namespace

Points pointsOf(const Doubles& rows) { return copied<Vector3>(rows); }

std::vector<Triangle> trianglesOf(const Indices& rows) { return copied<Triangle>(rows); }

const char* wordOf(ZPositive way) {
  switch (way) {
  case ZPositive::Up:
    return "up";
  case ZPositive::Down:
    return "down";
  case ZPositive::Unknown:
    break;
  }
  return "auto";
}

ZPositive wayOf(const std::string& word) { return word == "up" ? ZPositive::Up : word == "down" ? ZPositive::Down : ZPositive::Unknown; }

py::dict dictOf(TriangleMesh&& mesh) {
  py::dict d, fields;
  d["vertices"] = arrayOf(std::move(mesh.vertices));
  d["triangles"] = arrayOf(std::move(mesh.triangles));
  d["normals"] = mesh.normals.empty() ? py::object(py::none()) : py::object(arrayOf(std::move(mesh.normals)));
  d["pieces"] = mesh.piece.empty() ? py::object(py::none()) : py::object(handOver<Index>(std::move(mesh.piece), 0));
  for (auto& [name, values] : mesh.scalars)
    fields[py::str(name)] = handOver<float>(std::move(values), 0);
  d["fields"] = fields;
  return d;
}

TriangleMesh meshOf(const py::dict& d) {
  TriangleMesh mesh;
  mesh.vertices = pointsOf(d["vertices"].cast<Doubles>());
  mesh.triangles = trianglesOf(d["triangles"].cast<Indices>());
  if (!d["normals"].is_none())
    mesh.normals = pointsOf(d["normals"].cast<Doubles>());
  if (!d["pieces"].is_none())
    mesh.piece = copied<Index>(d["pieces"].cast<Indices>());
  for (const auto& [name, values] : d["fields"].cast<py::dict>())
    mesh.scalars[name.cast<std::string>()] = copied<float>(values.cast<Floats>());
  return mesh;
}

py::dict dictOf(PickSet&& picks) {
  py::dict d;
  d["points"] = arrayOf(std::move(picks.points));
  d["normals"] = picks.normals.empty() ? py::object(py::none()) : py::object(arrayOf(std::move(picks.normals)));
  d["z_positive"] = wordOf(picks.z_positive);
  d["xy_unit"] = picks.xy_unit;
  d["z_unit"] = picks.z_unit;
  d["source"] = picks.source;
  d["horizon"] = picks.horizon;
  d["notes"] = picks.notes;
  d["warnings"] = picks.warnings;
  d["z_reason"] = picks.z_reason;
  return d;
}

PickSet picksOf(const py::dict& d) {
  PickSet picks;
  picks.points = pointsOf(d["points"].cast<Doubles>());
  picks.z_positive = wayOf(d["z_positive"].cast<std::string>());
  picks.xy_unit = d["xy_unit"].cast<std::string>();
  picks.z_unit = d["z_unit"].cast<std::string>();
  picks.source = d["source"].cast<std::string>();
  picks.horizon = d["horizon"].cast<std::string>();
  picks.notes = d["notes"].cast<std::vector<std::string>>();
  picks.warnings = d["warnings"].cast<std::vector<std::string>>();
  picks.z_reason = d["z_reason"].cast<std::string>();
  return picks;
}

py::dict dictOf(FaultInput&& fault) {
  py::dict d;
  d["name"] = fault.name;
  d["mesh"] = py::none();
  d["sticks"] = py::none();
  if (auto* mesh = std::get_if<TriangleMesh>(&fault.geometry))
    d["mesh"] = dictOf(std::move(*mesh));
  else
    d["sticks"] = listOf(std::move(std::get<std::vector<FaultStick>>(fault.geometry)));
  d["z_positive"] = wordOf(fault.z_positive);
  d["source"] = fault.source;
  d["notes"] = fault.notes;
  d["warnings"] = fault.warnings;
  return d;
}

FaultInput faultOf(const py::dict& d) {
  FaultInput fault;
  fault.name = d["name"].cast<std::string>();
  if (d["mesh"].is_none())
    fault.geometry = sticksOf(d["sticks"].cast<py::list>());
  else
    fault.geometry = meshOf(d["mesh"].cast<py::dict>());
  fault.z_positive = wayOf(d["z_positive"].cast<std::string>());
  fault.source = d["source"].cast<std::string>();
  fault.notes = d["notes"].cast<std::vector<std::string>>();
  fault.warnings = d["warnings"].cast<std::vector<std::string>>();
  return fault;
}

std::vector<FaultInput> faultsOf(const py::list& list) {
  std::vector<FaultInput> faults;
  for (const py::handle& fault : list)
    faults.push_back(faultOf(fault.cast<py::dict>()));
  return faults;
}

} // namespace graben::python
