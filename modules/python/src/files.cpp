#include "bindings.h"
#include "convert.h"
#include "job.h"

#include "graben/io/dip_reader.h"
#include "graben/io/mesh_reader.h"
#include "graben/io/mesh_writer.h"
#include "graben/io/pick_reader.h"
#include "support/horizon_options.h"

namespace graben::python {
namespace {

/// \param[in] words options of the commands that read picks: --columns and --null
ReadOptions tableOptions(const std::vector<std::string>& words, unsigned threads) {
  OptionParser parser("graben", "");
  declareTableOptions(parser);
  ReadOptions options = readOptions(parser.parse(words));
  options.threads = threads;
  return options;
}

py::dict readPicksFile(const std::string& path, const std::string& horizon, const std::vector<std::string>& words, unsigned threads,
                       const py::object& progress) {
  ReadOptions options = tableOptions(words, threads);
  const PickSource source = horizon.empty() ? splitPickSource(path) : PickSource{path, horizon};
  options.horizon = source.horizon;
  PickSet picks;
  runJob(progress, [&](const ProgressCallback& callback) {
    options.progress = callback;
    picks = readPicks(source.path, options);
  });
  return dictOf(std::move(picks));
}

py::list readFaultsFile(const std::string& path) {
  std::vector<FaultInput> faults;
  runJob(py::none(), [&](const ProgressCallback&) { faults = readFaults(path); });
  py::list list;
  for (FaultInput& fault : faults)
    list.append(dictOf(std::move(fault)));
  return list;
}

py::list readMeshFile(const std::string& path) {
  std::vector<MeshInput> meshes;
  runJob(py::none(), [&](const ProgressCallback&) { meshes = readMeshes(path); });
  py::list list;
  for (MeshInput& input : meshes) {
    py::dict d = dictOf(std::move(input.mesh));
    d["name"] = input.name;
    d["z_positive"] = wordOf(input.z_positive);
    d["notes"] = input.notes;
    d["warnings"] = input.warnings;
    list.append(d);
  }
  return list;
}

py::tuple readDipsFile(const std::string& path, const std::vector<std::string>& words) {
  DipSet set;
  const ReadOptions options = tableOptions(words, 0);
  runJob(py::none(), [&](const ProgressCallback&) { set = readDips(path, options); });
  Points places, normals;
  for (const DipMeasurement& dip : set.dips) {
    places.push_back(dip.place);
    normals.push_back(dip.normal);
  }
  return py::make_tuple(arrayOf(std::move(places)), arrayOf(std::move(normals)), set.notes);
}

py::array normalsOfDips(const Doubles& dip_azimuth) {
  Points normals;
  for (py::ssize_t i = 0; i < dip_azimuth.shape(0); ++i)
    normals.push_back(normalOf(DipAzimuth{dip_azimuth.at(i, 0), dip_azimuth.at(i, 1)}));
  return arrayOf(std::move(normals));
}

std::vector<std::string> writeMeshFile(const std::string& path, const py::dict& mesh, const std::string& name, const std::string& z_positive) {
  const TriangleMesh written = meshOf(mesh);
  MeshWriteOptions options;
  options.name = name;
  options.z_positive = wayOf(z_positive);
  std::vector<std::string> notes;
  runJob(py::none(), [&](const ProgressCallback&) { notes = writeMesh(path, written, options); });
  return notes;
}

} // namespace

void bindFiles(py::module_& m) {
  m.def("read_picks", &readPicksFile, py::arg("path"), py::arg("horizon"), py::arg("words"), py::arg("threads"), py::arg("progress"));
  m.def("read_faults", &readFaultsFile, py::arg("path"));
  m.def("read_meshes", &readMeshFile, py::arg("path"));
  m.def("read_dips", &readDipsFile, py::arg("path"), py::arg("words"));
  m.def("normals_of_dips", &normalsOfDips, py::arg("dip_azimuth"));
  m.def("write_mesh", &writeMeshFile, py::arg("path"), py::arg("mesh"), py::arg("name"), py::arg("z_positive"));
}

} // namespace graben::python
