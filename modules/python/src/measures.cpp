#include "bindings.h"
#include "convert.h"
#include "job.h"

#include "graben/features/sampling.h"
#include "graben/features/mean_distance.h"
#include "graben/features/pick_layout.h"
#include "graben/visualization/map_picture.h"
#include "support/evaluation_report.h"

namespace graben::python {
namespace {

py::dict sampling(const Doubles& rows, unsigned threads) {
  const Points points = pointsOf(rows);
  Sampling found;
  PickLayout layout;
  double mean_distance = 0.0;
  runJob(py::none(), [&](const ProgressCallback&) {
    const NeighborGrid grid(points, 0.0, threads);
    found = estimateSampling(grid, threads);
    layout = pickLayout(grid, threads);
    mean_distance = meanPickDistance(grid, threads);
  });
  py::dict d;
  d["spacing"] = found.spacing;
  d["mean_distance"] = mean_distance;
  d["rho"] = found.rho;
  d["delta"] = found.delta;
  d["sigma"] = found.sigma;
  d["along_lines"] = layout.along_lines;
  d["line_distance"] = layout.line_distance;
  d["along"] = layout.along;
  d["share_on_lines"] = layout.share;
  return d;
}

MeshInput meshInputOf(const py::dict& mesh, const std::string& name) {
  MeshInput input;
  input.name = name;
  input.mesh = meshOf(mesh);
  return input;
}

py::str evaluate(const std::vector<std::string>& words, const py::dict& mesh, const py::dict& picks, const py::list& faults, const py::object& truth,
                 const py::list& cutoffs) {
  OptionParser parser("graben.evaluate", "");
  declareEvaluationInput(parser);
  declareMeasuring(parser);
  const OptionValues values = parser.parse(words);
  EvaluationParts parts;
  parts.mesh.push_back(meshInputOf(mesh, "mesh"));
  parts.picks = picksOf(picks);
  parts.faults = faultsOf(faults);
  if (!truth.is_none())
    parts.truth.push_back({"truth", meshInputOf(truth.cast<py::dict>(), "truth")});
  parts.cutoffs = faultsOf(cutoffs);
  std::string json;
  runJob(py::none(), [&](const ProgressCallback&) {
    const EvaluationFiles files = joinEvaluation(values, parts);
    json = evaluationJson(values, files, evaluateSurface(files.input, evaluationOptions(values)), values.number("sigma", 0.0));
  });
  return json;
}

/// \param[in] faults tuples: name, cutoff lines, gaps, overlaps
std::vector<MapFault> mapFaultsOf(const py::list& faults) {
  const auto lines = [](const py::handle& list) {
    std::vector<Points> all;
    for (const py::handle& line : list)
      all.push_back(pointsOf(line.cast<Doubles>()));
    return all;
  };
  std::vector<MapFault> list;
  for (const py::handle& handle : faults) {
    const auto fault = handle.cast<py::tuple>();
    list.push_back({fault[0].cast<std::string>(), lines(fault[1]), lines(fault[2]), lines(fault[3])});
  }
  return list;
}

/// \param[in] field drawn in colours; empty: heights with contour lines
void drawMapFile(const std::string& stem, const py::dict& mesh, const py::list& faults, const std::string& z_positive, const std::string& field, int width,
                 int height) {
  const TriangleMesh drawn = meshOf(mesh);
  MapScene scene;
  scene.mesh = &drawn;
  scene.faults = mapFaultsOf(faults);
  MapOptions options;
  options.formats.svg = false;
  options.units.z_positive = wayOf(z_positive);
  options.title = field.empty() ? "Horizon" : field;
  options.colors = field.empty() ? MapColors::Height : MapColors::Scalar;
  options.scalar = options.values_title = field;
  options.width = width;
  options.height = height;
  runJob(py::none(), [&](const ProgressCallback&) { drawMap(stem, scene, options); });
}

} // namespace

void bindMeasures(py::module_& m) {
  m.def("sampling", &sampling, py::arg("points"), py::arg("threads"));
  m.def("evaluate", &evaluate, py::arg("words"), py::arg("mesh"), py::arg("picks"), py::arg("faults"), py::arg("truth"), py::arg("cutoffs"));
  m.def("draw_map", &drawMapFile, py::arg("stem"), py::arg("mesh"), py::arg("faults"), py::arg("z_positive"), py::arg("field"),
        py::arg("width"), py::arg("height"));
}

} // namespace graben::python
