#include "bindings.h"
#include "convert.h"
#include "job.h"

#include "graben/core/errors.h"
#include "graben/core/local_frame.h"
#include "graben/faults/fault_lofting.h"
#include "graben/features/fault_constrained_normal_estimation.h"
#include "graben/mesh/conversions.h"
#include "graben/surface/fault_cutter.h"
#include "graben/surface/hoppe_marching_cubes.h"
#include "graben/surface/qem_fault_fitter.h"

namespace graben::python {
namespace {

/// Single precision about the middle of what is given, as the PCL classes want it.
class Local {
public:
  explicit Local(const Points& points) : frame_(LocalFrame::around(points)) {}

  pcl::PointCloud<pcl::PointNormal>::Ptr cloud(const Points& points, const Points& normals) const {
    auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointNormal>>();
    cloud->resize(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      (*cloud)[i].getVector3fMap() = frame_.toLocal(points[i]).cast<float>();
      if (!normals.empty())
        (*cloud)[i].getNormalVector3fMap() = normals[i].cast<float>();
    }
    return cloud;
  }

  pcl::PolygonMesh::Ptr mesh(TriangleMesh mesh) const {
    for (Vector3& p : mesh.vertices)
      p = frame_.toLocal(p);
    auto out = pcl::make_shared<pcl::PolygonMesh>();
    toPolygonMesh(mesh, *out);
    return out;
  }

  TriangleMesh back(const pcl::PolygonMesh& mesh) const {
    TriangleMesh out = fromPolygonMesh(mesh);
    for (Vector3& p : out.vertices)
      p = frame_.toUser(p);
    return out;
  }

  std::shared_ptr<const FaultNetwork> faults(const std::vector<FaultInput>& inputs) const {
    std::vector<FaultSurface> surfaces;
    for (const FaultInput& input : inputs)
      for (FaultSurface& surface : lofted(input).faults)
        surfaces.push_back(std::move(surface));
    return std::make_shared<const FaultNetwork>(std::move(surfaces));
  }

private:
  LoftedFaults lofted(const FaultInput& input) const {
    if (const auto* mesh = std::get_if<TriangleMesh>(&input.geometry)) {
      TriangleMesh moved = *mesh;
      for (Vector3& p : moved.vertices)
        p = frame_.toLocal(p);
      return meshedFault(input.name, moved);
    }
    std::vector<FaultStick> sticks = std::get<std::vector<FaultStick>>(input.geometry);
    for (FaultStick& stick : sticks)
      for (Vector3& p : stick.points)
        p = frame_.toLocal(p);
    return loftFaults(input.name, sticks);
  }

  LocalFrame frame_;
};

/// An option that was given.
template <typename Value, typename Set>
void given(const py::dict& options, const char* name, const Set& set) {
  if (options.contains(name) && !options[name].is_none())
    set(options[name].cast<Value>());
}

py::tuple normals(const Doubles& rows, const py::list& faults, const py::dict& options) {
  using Estimation = FaultConstrainedNormalEstimation<pcl::PointNormal, pcl::PointNormal>;
  const Points points = pointsOf(rows);
  const std::vector<FaultInput> inputs = faultsOf(faults);
  Estimation estimation;
  given<unsigned>(options, "threads", [&](unsigned n) { estimation.setNumberOfThreads(n); });
  given<int>(options, "neighbors", [&](int k) { estimation.setNeighbors(k); });
  given<double>(options, "rho", [&](double rho) { estimation.setRho(rho); });
  given<double>(options, "delta", [&](double delta) { estimation.setDelta(delta); });
  given<std::string>(options, "orientation", [&](const std::string& way) {
    estimation.setOrientation(way == "up" ? NormalOrientation::UpAxis : NormalOrientation::SpanningTree);
  });
  pcl::PointCloud<pcl::PointNormal> found;
  runJob(py::none(), [&](const ProgressCallback&) {
    const Local local(points);
    estimation.setFaults(local.faults(inputs));
    estimation.setInputCloud(local.cloud(points, {}));
    estimation.compute(found);
    if (estimation.getStatus() == NormalEstimationStatus::Failed)
      throw InvalidInputError("normals", estimation.getStatusMessage());
  });
  Points result;
  std::vector<float> curvature;
  for (const pcl::PointNormal& p : found) {
    result.push_back(p.getNormalVector3fMap().cast<double>());
    curvature.push_back(p.curvature);
  }
  return py::make_tuple(arrayOf(std::move(result)), handOver<float>(std::move(curvature), 0));
}

template <typename Step>
void checkStatus(const Step& step, const char* stage) {
  if (step.getStatus() == SurfaceStatus::Failed)
    throw InvalidInputError(stage, step.getStatusMessage());
}

py::dict marchingCubes(const Doubles& rows, const Doubles& normal_rows, const py::list& faults, const py::dict& options) {
  const Points points = pointsOf(rows), facing = pointsOf(normal_rows);
  const std::vector<FaultInput> inputs = faultsOf(faults);
  HoppeMarchingCubes<pcl::PointNormal> cubes;
  given<unsigned>(options, "threads", [&](unsigned n) { cubes.setNumberOfThreads(n); });
  given<double>(options, "voxel_size", [&](double h) { cubes.setVoxelSize(h); });
  given<double>(options, "rho", [&](double rho) { cubes.setRho(rho); });
  given<double>(options, "delta", [&](double delta) { cubes.setDelta(delta); });
  given<double>(options, "flip_angle", [&](double angle) { cubes.setFlipAngle(angle); });
  given<double>(options, "fault_reach", [&](double reach) { cubes.setFaultReach(reach); });
  TriangleMesh result;
  runJob(py::none(), [&](const ProgressCallback&) {
    const Local local(points);
    pcl::PolygonMesh mesh;
    cubes.setFaults(local.faults(inputs));
    cubes.setInputCloud(local.cloud(points, facing));
    cubes.reconstruct(mesh);
    checkStatus(cubes, "marching_cubes");
    result = local.back(mesh);
  });
  return dictOf(std::move(result));
}

py::dict cut(const py::dict& mesh, const py::list& faults, double tolerance, unsigned threads) {
  TriangleMesh given_mesh = meshOf(mesh);
  const std::vector<FaultInput> inputs = faultsOf(faults);
  FaultCutter cutter;
  cutter.setTolerance(tolerance);
  cutter.setNumberOfThreads(threads);
  TriangleMesh result;
  runJob(py::none(), [&](const ProgressCallback&) {
    const Local local(given_mesh.vertices);
    pcl::PolygonMesh out;
    cutter.setFaults(local.faults(inputs));
    cutter.setInputMesh(local.mesh(std::move(given_mesh)));
    cutter.process(out);
    checkStatus(cutter, "cut");
    result = local.back(out);
  });
  return dictOf(std::move(result));
}

py::tuple fit(const py::dict& mesh, const Doubles& rows, const Doubles& normal_rows, const py::list& faults, const py::dict& options) {
  TriangleMesh given_mesh = meshOf(mesh);
  const Points points = pointsOf(rows), facing = pointsOf(normal_rows);
  const std::vector<FaultInput> inputs = faultsOf(faults);
  QEMFaultFitter fitter;
  given<unsigned>(options, "threads", [&](unsigned n) { fitter.setNumberOfThreads(n); });
  given<int>(options, "neighbors", [&](int k) { fitter.setNeighbors(k); });
  given<double>(options, "zone_width", [&](double width) { fitter.setZoneWidth(width); });
  given<double>(options, "search_radius", [&](double radius) { fitter.setSearchRadius(radius); });
  given<double>(options, "max_step", [&](double step) { fitter.setMaxStep(step); });
  given<unsigned>(options, "passes", [&](unsigned passes) { fitter.setPasses(passes); });
  given<std::string>(options, "fit", [&](const std::string& mode) {
    fitter.setFitMode(mode == "off" ? FitMode::Off : mode == "normal" ? FitMode::Normal : FitMode::Full);
  });
  TriangleMesh result;
  runJob(py::none(), [&](const ProgressCallback&) {
    const Local local(given_mesh.vertices);
    pcl::PolygonMesh out;
    fitter.setFaults(local.faults(inputs));
    fitter.setInputCloud(local.cloud(points, facing));
    fitter.setInputMesh(local.mesh(std::move(given_mesh)));
    fitter.process(out);
    checkStatus(fitter, "fit");
    result = local.back(out);
  });
  return py::make_tuple(dictOf(std::move(result)), fitter.getResult().fitted, fitter.getResult().without_picks);
}

} // namespace

void bindSteps(py::module_& m) {
  m.def("normals", &normals, py::arg("points"), py::arg("faults"), py::arg("options"));
  m.def("marching_cubes", &marchingCubes, py::arg("points"), py::arg("normals"), py::arg("faults"), py::arg("options"));
  m.def("cut", &cut, py::arg("mesh"), py::arg("faults"), py::arg("tolerance"), py::arg("threads"));
  m.def("fit", &fit, py::arg("mesh"), py::arg("points"), py::arg("normals"), py::arg("faults"), py::arg("options"));
}

} // namespace graben::python
