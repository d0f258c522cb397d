#include "graben/surface/qem_fault_fitter.h"

#include "graben/core/errors.h"
#include "graben/core/threads.h"
#include "graben/faults/triangles_near.h"
#include "graben/features/cloud_normals.h"
#include "graben/features/mean_distance.h"
#include "graben/features/sampling.h"
#include "graben/mesh/adjacency.h"
#include "graben/mesh/median_edge.h"

#include <algorithm>

namespace graben {

namespace {

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

constexpr double kShortestNormal = 0.5;

/// Edges that pass through a fault with both ends off it: a mesh that is cut has none.
std::size_t crossingEdges(const CutMesh& cut, const FaultNetwork& faults, unsigned threads) {
  const std::vector<Index> near = trianglesNear(faults, cut.mesh, 0.0, threads);
  return joinBlocks<Index>(near.size(), 256, threads, [&](std::size_t begin, std::size_t end, std::vector<Index>& found) {
           for (std::size_t i = begin; i < end; ++i) {
             const Triangle& t = cut.mesh.triangles[static_cast<std::size_t>(near[i])];
             for (std::size_t e = 0; e < 3; ++e) {
               const Index a = t[e], b = t[(e + 1) % 3];
               if (!cut.onFault(a) && !cut.onFault(b) &&
                   faults.crosses(cut.mesh.vertices[static_cast<std::size_t>(a)], cut.mesh.vertices[static_cast<std::size_t>(b)]))
                 found.push_back(near[i]);
             }
           }
         })
    .size();
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
  check(picks_ != nullptr && cloud_size_() > 0, "The cloud to fit to is missing or empty.");
  for (const double length : {options_.zone_width, options_.search_radius, options_.max_step})
    check(length >= 0.0, "The zone width, search radius and longest step must be positive, or 0 to "
                         "have them estimated.");
  check(neighbors_ >= 3, "A fit needs at least 3 neighbors.");
  check(options_.relative_cutoff >= 0.0 && options_.relative_cutoff <= 1.0,
        "The relative cut-off must be 0 to 1.");
}

std::vector<QEMFaultFitter::Pick> QEMFaultFitter::readPicks() const {
  const std::size_t size = cloud_size_();
  std::vector<Pick> picks;
  picks.reserve(indices_ ? indices_->size() : size);
  const auto take = [&](std::size_t i) {
    Pick pick = picks_(i);
    if (pick.place.allFinite() && (!with_normals_ || (pick.normal.allFinite() && pick.normal.norm() > kShortestNormal)))
      picks.push_back(std::move(pick));
  };
  for (std::size_t i = 0; !indices_ && i < size; ++i)
    take(i);
  if (indices_)
    for (const pcl::index_t i : *indices_) {
      if (i < 0 || static_cast<std::size_t>(i) >= size)
        throw InvalidInputError("fitting", "An index lies outside the cloud to fit to.");
      take(static_cast<std::size_t>(i));
    }
  if (picks.empty())
    throw InvalidInputError("fitting", with_normals_ ? "No point of the cloud is finite and has a normal." : "No point of the cloud is finite.");
  return picks;
}

TangentPlanes QEMFaultFitter::planes() const {
  TangentPlanes planes;
  for (const Pick& pick : readPicks()) {
    planes.centres.push_back(pick.place);
    if (with_normals_)
      planes.normals.push_back(pick.normal.normalized());
  }
  if (with_normals_)
    return planes;
  CloudNormalOptions o;
  o.orientation = NormalOrientation::UpAxis; // which way they point makes no difference
  o.planes.threads = threads();
  planes.normals = estimateCloudNormals(planes.centres, faults(), o).planes.normals;
  return planes;
}

ZoneFitOptions QEMFaultFitter::withEstimates(double edge, const NeighborGrid& grid) const {
  ZoneFitOptions o = options_;
  o.neighbors = static_cast<std::size_t>(neighbors_);
  o.threads = threads();
  if (o.zone_width == 0.0)
    o.zone_width = 5.0 * edge;
  if (o.max_step == 0.0)
    o.max_step = edge;
  if (o.search_radius == 0.0 && o.mode != FitMode::Off)
    o.search_radius = searchRadius(grid, threads());
  return o;
}

void QEMFaultFitter::sayWhatLooksWrong(const CutMesh& cut) {
  if (options_.mode == FitMode::Off)
    return;
  if (faults().empty() && result_.fitted + result_.without_picks == 0)
    warn("There are no faults, so nothing was fitted; a zone width of infinity fits the whole mesh.");
  if (const std::size_t edges = crossingEdges(cut, faults(), threads()); edges > 0)
    warn("The mesh is not cut along the faults: " + std::to_string(edges) +
         " of its edges pass through one, so that vertices were fitted to picks of one side but hang together with the other. Use FaultCutter first.");
  if (result_.fitted == 0 && result_.without_picks > 0)
    warn("None of the " + std::to_string(result_.without_picks) +
         " vertices to be fitted has three picks within reach, so nothing was fitted. Is the cloud in the mesh's frame (origin, units)?");
}

CutMesh QEMFaultFitter::processMesh(TriangleMesh mesh, double tolerance) {
  result_ = {};
  used_ = {};
  checkOptions();
  const TangentPlanes planes = this->planes();
  const NeighborGrid grid(planes.centres, 0.0, threads());
  used_ = withEstimates(medianEdge(mesh), grid);
  CutMesh cut = withVertexFaults(std::move(mesh), faults(), tolerance, threads());
  result_ = fitZone(cut, grid, planes, faults(), used_);
  sayWhatLooksWrong(cut);
  return cut;
}

} // namespace graben
