#include "graben/surface/qem_fault_fitter.h"

#include "graben/core/errors.h"
#include "graben/core/threads.h"
#include "graben/features/sampling.h"
#include "graben/mesh/adjacency.h"
#include "graben/features/mean_distance.h"

#include <algorithm>
#include <cmath>

namespace graben {

namespace {

double medianEdge(const TriangleMesh& mesh) {
  std::vector<double> lengths;
  lengths.reserve(3 * mesh.triangles.size());
  for (const Triangle& t : mesh.triangles)
    for (std::size_t e = 0; e < 3; ++e)
      lengths.push_back((mesh.vertices[static_cast<std::size_t>(t[e])] -
                         mesh.vertices[static_cast<std::size_t>(t[(e + 1) % 3])])
                            .norm());
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  return *middle;
}

/// The one or two faults nearest to a place, of those within the tolerance, in rising order.
std::array<Index, 2> faultsAt(const FaultNetwork& faults, const Vector3& p, double tolerance) {
  std::vector<std::pair<double, Index>> found;
  for (std::size_t f = 0; f < faults.size(); ++f) {
    const FaultPoint point = faults.nearest(f, p, tolerance);
    if (point.fault >= 0)
      found.emplace_back(point.distance, point.fault);
  }
  std::sort(found.begin(), found.end());
  if (found.empty())
    return {-1, -1};
  if (found.size() == 1)
    return {found[0].second, -1};
  return {std::min(found[0].second, found[1].second), std::max(found[0].second, found[1].second)};
}

CutMesh withVertexFaults(TriangleMesh mesh, const FaultNetwork& faults, double tolerance,
                         unsigned threads) {
  CutMesh cut;
  cut.mesh = std::move(mesh);
  cut.vertex_faults.assign(cut.mesh.vertices.size(), {-1, -1});
  const EdgeAdjacency adjacency(cut.mesh);
  std::vector<std::uint8_t> border(cut.mesh.vertices.size(), 0);
  for (std::size_t t = 0; t < cut.mesh.triangles.size(); ++t)
    for (std::size_t e = 0; e < 3; ++e)
      if (adjacency.isBorder(static_cast<Index>(3 * t + e)))
        for (const Index v : {cut.mesh.triangles[t][e], cut.mesh.triangles[t][(e + 1) % 3]})
          border[static_cast<std::size_t>(v)] = 1;
  parallelFor(border.size(), 256, threads, [&](std::size_t v) {
    if (border[v] != 0)
      cut.vertex_faults[v] = faultsAt(faults, cut.mesh.vertices[v], tolerance);
  });
  return cut;
}

void readCloud(const QEMFaultFitter::Cloud& cloud, TangentPlanes& planes) {
  constexpr float kShortest = 0.5F;
  for (const pcl::PointNormal& p : cloud) {
    if (!p.getVector3fMap().allFinite() || !p.getNormalVector3fMap().allFinite() ||
        !(p.getNormalVector3fMap().norm() > kShortest))
      continue;
    planes.centres.push_back(p.getVector3fMap().cast<double>());
    planes.normals.push_back(p.getNormalVector3fMap().cast<double>().normalized());
  }
}

double searchRadius(const NeighborGrid& grid, unsigned threads) {
  const Sampling sampling = estimateSampling(grid, threads);
  const double boundary = sampling.rho + sampling.delta;
  return std::max(6.0 * meanPickDistance(grid, threads), 2.0 * boundary) + 2.0 * boundary;
}

} // namespace

void QEMFaultFitter::checkOptions() const {
  const auto check = [](bool good, const char* message) {
    if (!good)
      throw InvalidInputError("fitting", message);
  };
  check(cloud_ != nullptr && !cloud_->empty(), "The cloud to fit to is missing or empty.");
  for (const double length : {options_.zone_width, options_.search_radius, options_.max_step})
    check(length >= 0.0, "The zone width, search radius and longest step must be positive, or 0 to "
                         "have them estimated.");
  check(neighbors_ >= 3, "A fit needs at least 3 neighbors.");
  check(options_.relative_cutoff >= 0.0 && options_.relative_cutoff <= 1.0,
        "The relative cut-off must be 0 to 1.");
}

CutMesh QEMFaultFitter::processMesh(TriangleMesh mesh) {
  result_ = {};
  used_zone_width_ = 0.0;
  checkOptions();
  TangentPlanes planes;
  readCloud(*cloud_, planes);
  if (planes.centres.empty())
    throw InvalidInputError("fitting", "No point of the cloud is finite and has a normal.");
  const NeighborGrid grid(planes.centres, 0.0, threads());

  const double edge = medianEdge(mesh);
  ZoneFitOptions options = options_;
  options.neighbors = static_cast<std::size_t>(neighbors_);
  options.threads = threads();
  if (options.zone_width == 0.0)
    options.zone_width = 5.0 * edge;
  if (options.max_step == 0.0)
    options.max_step = edge;
  if (options.search_radius == 0.0 && options.mode != FitMode::Off)
    options.search_radius = searchRadius(grid, threads());
  used_zone_width_ = options.zone_width;

  CutMesh cut = withVertexFaults(std::move(mesh), faults(),
                                 tolerance() > 0.0 ? tolerance() : 0.02 * edge, threads());
  result_ = fitZone(cut, grid, planes, faults(), options);
  return cut;
}

} // namespace graben
