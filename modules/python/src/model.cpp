#include "bindings.h"
#include "convert.h"
#include "job.h"

#include "graben/model/model_section.h"
#include "support/model_folder.h"
#include "support/model_options.h"

#include <algorithm>
#include <stdexcept>

namespace graben::python {
namespace {

constexpr const char* kKinds[] = {"wall", "top", "base", "horizon", "fault"};

SealedSurfaceKind kindOf(const std::string& word) {
  const auto* found = std::find(std::begin(kKinds), std::end(kKinds), word);
  if (found == std::end(kKinds))
    throw std::invalid_argument("a surface of a model cannot be a '" + word + "'");
  return static_cast<SealedSurfaceKind>(found - std::begin(kKinds));
}

/// All of a sealed mesh, as Python keeps it.
py::dict sealedDict(SealedMesh&& mesh) {
  py::list surfaces, blocks;
  for (const SealedSurface& surface : mesh.surfaces)
    surfaces.append(py::make_tuple(surface.name, kKinds[static_cast<std::size_t>(surface.kind)]));
  for (const SealedBlock& block : mesh.blocks)
    blocks.append(py::make_tuple(block.name, block.layer, block.volume, block.area, block.fault_side));
  py::dict d;
  d["vertices"] = arrayOf(std::move(mesh.vertices));
  d["triangles"] = arrayOf(std::move(mesh.triangles));
  d["triangle_patch"] = handOver<Index>(std::move(mesh.triangle_patch), 0);
  d["patches"] = handOver<Index>(std::move(mesh.patches), 3);
  d["surfaces"] = surfaces;
  d["blocks"] = blocks;
  return d;
}

SealedMesh sealedOf(const py::dict& d) {
  SealedMesh mesh;
  mesh.vertices = pointsOf(d["vertices"].cast<Doubles>());
  mesh.triangles = trianglesOf(d["triangles"].cast<Indices>());
  mesh.triangle_patch = d["triangle_patch"].cast<std::vector<Index>>();
  for (const auto& row : d["patches"].cast<std::vector<std::array<Index, 3>>>())
    mesh.patches.push_back({row[0], row[1], row[2]});
  for (const auto& [name, kind] : d["surfaces"].cast<std::vector<std::pair<std::string, std::string>>>())
    mesh.surfaces.push_back({name, kindOf(kind)});
  for (const auto& [name, layer, volume, area, side] : d["blocks"].cast<std::vector<std::tuple<std::string, Index, double, double, std::vector<int>>>>())
    mesh.blocks.push_back({name, layer, volume, area, side});
  return mesh;
}

HorizonRelation relationOf(const std::string& word) {
  if (word == "erosional")
    return HorizonRelation::Erosional;
  if (word == "onlap")
    return HorizonRelation::Onlap;
  if (word == "conformable")
    return HorizonRelation::Conformable;
  throw std::invalid_argument("horizons: the relation '" + word + "' is not one of conformable, erosional, onlap");
}

py::list horizonsOf(ModelResult& model) {
  py::list list;
  for (ModelHorizonResult& horizon : model.horizons) {
    py::dict d = dictOf(std::move(horizon.mesh));
    d["name"] = horizon.name;
    d["report"] = toJson(horizon.report);
    list.append(d);
  }
  return list;
}

py::dict modelDict(ModelResult&& model) {
  py::list defects, faults;
  for (const SealedDefect& defect : model.check.defects)
    defects.append(defect.what);
  for (FaultSurface& fault : model.faults) {
    py::dict mesh = dictOf(std::move(fault.mesh));
    mesh["name"] = fault.name;
    faults.append(mesh);
  }
  py::dict d;
  d["report"] = modelJson(model);
  d["z_positive"] = wordOf(model.frame.z_positive);
  d["defects"] = defects;
  d["horizons"] = horizonsOf(model);
  d["faults"] = faults;
  d["sealed"] = sealedDict(std::move(model.sealed));
  return d;
}

py::dict makeModel(const std::vector<std::string>& words, const py::list& horizons, const py::list& faults, const py::object& progress) {
  OptionParser parser("graben.model", "");
  declareModelOptions(parser);
  const OptionValues values = parser.parse(words);
  std::vector<NamedPicks> named;
  for (const py::handle& handle : horizons) {
    const auto horizon = handle.cast<py::tuple>();
    named.push_back({horizon[0].cast<std::string>(), picksOf(horizon[1].cast<py::dict>()), relationOf(horizon[2].cast<std::string>())});
  }
  std::vector<FaultInput> fault_inputs = faultsOf(faults);
  ModelResult model;
  std::vector<std::string> warnings, notes;
  runJob(progress, [&](const ProgressCallback& callback) {
    ModelInput input = joinModelInput(values, std::move(named), std::move(fault_inputs));
    input.options.reconstruction.progress = callback;
    model = ModelReconstruction(input.options).reconstruct(std::move(input.horizons), input.faults);
    warnings = std::move(input.warnings);
    notes = std::move(input.notes);
  });
  warnings.insert(warnings.end(), model.warnings.begin(), model.warnings.end());
  notes.insert(notes.end(), model.notes.begin(), model.notes.end());
  py::dict d = modelDict(std::move(model));
  d["warnings"] = warnings;
  d["notes"] = notes;
  return d;
}

std::size_t indexIn(std::size_t count, std::size_t index, const char* what) {
  if (index >= count)
    throw py::index_error(std::string("the model has ") + std::to_string(count) + " " + what);
  return index;
}

py::dict blockMesh(const py::dict& sealed, std::size_t block) {
  const SealedMesh mesh = sealedOf(sealed);
  return dictOf(blockSurface(mesh, static_cast<Index>(indexIn(mesh.blocks.size(), block, "blocks"))));
}

py::dict surfaceMesh(const py::dict& sealed, std::size_t surface) {
  const SealedMesh mesh = sealedOf(sealed);
  return dictOf(patchesOf(mesh, static_cast<Index>(indexIn(mesh.surfaces.size(), surface, "surfaces"))));
}

py::array lineOf(std::vector<SectionPoint2>&& points) { return handOver<double>(std::move(points), 2); }

py::dict sectionDict(ModelSection&& cut, const SealedMesh& mesh) {
  const auto nameOf = [&mesh](Index surface) { return mesh.surfaces[static_cast<std::size_t>(surface)].name; };
  py::list polygons, traces, throws;
  for (SectionPolygon& polygon : cut.polygons) {
    py::list rings;
    for (auto& ring : polygon.rings)
      rings.append(lineOf(std::move(ring)));
    polygons.append(py::make_tuple(mesh.blocks[static_cast<std::size_t>(polygon.block)].name, rings, polygon.area));
  }
  for (SectionTrace& trace : cut.traces)
    traces.append(py::make_tuple(nameOf(trace.surface), lineOf(std::move(trace.points))));
  for (const SectionThrow& t : cut.throws)
    throws.append(py::make_tuple(nameOf(t.fault), nameOf(t.horizon), lineOf({t.footwall, t.hanging_wall}), t.apparent, t.along_dip));
  py::dict d;
  d["length"] = cut.length();
  d["blocks"] = polygons;
  d["lines"] = traces;
  d["throws"] = throws;
  return d;
}

py::dict section(const py::dict& sealed, const Doubles& line, const std::string& z_positive) {
  const SealedMesh mesh = sealedOf(sealed);
  std::vector<Eigen::Vector2d> way;
  for (py::ssize_t i = 0; i < line.shape(0); ++i)
    way.emplace_back(line.at(i, 0), line.at(i, 1));
  ModelSection cut;
  runJob(py::none(), [&](const ProgressCallback&) { cut = cutModel(mesh, way, wayOf(z_positive) == ZPositive::Down); });
  return sectionDict(std::move(cut), mesh);
}

void writeFile(const py::dict& sealed, const std::string& path, const std::string& z_positive) {
  ModelResult model;
  model.sealed = sealedOf(sealed);
  model.frame.z_positive = wayOf(z_positive);
  runJob(py::none(), [&](const ProgressCallback&) { writeModelFile(path, model); });
}

} // namespace

void bindModel(py::module_& m) {
  m.def("model", &makeModel, py::arg("words"), py::arg("horizons"), py::arg("faults"), py::arg("progress"));
  m.def("block_mesh", &blockMesh, py::arg("sealed"), py::arg("block"));
  m.def("surface_mesh", &surfaceMesh, py::arg("sealed"), py::arg("surface"));
  m.def("section", &section, py::arg("sealed"), py::arg("line"), py::arg("z_positive"));
  m.def("write_model", &writeFile, py::arg("sealed"), py::arg("path"), py::arg("z_positive"));
}

} // namespace graben::python
