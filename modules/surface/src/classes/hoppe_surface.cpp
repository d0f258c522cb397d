#include "graben/surface/hoppe_surface.h"

#include "graben/core/errors.h"
#include "graben/core/memory.h"
#include "graben/core/threads.h"
#include "graben/faults/out_of_reach.h"
#include "graben/features/mean_distance.h"
#include "graben/features/sampling.h"
#include "graben/filters/wrong_side_picks.h"
#include "graben/mesh/bounds.h"
#include "graben/mesh/normals.h"
#include "graben/surface/crumbs.h"
#include "graben/surface/data_border.h"
#include "graben/surface/fault_cut.h"
#include "graben/surface/nearest_in_sight.h"
#include "graben/surface/sheet_extraction.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace graben {

namespace {

void check(bool good, const char* message) {
  if (!good)
    throw InvalidInputError("marching cubes", message);
}

void checkOptions(const HoppeSurfaceOptions& o) {
  for (const double length : {o.voxel_size, o.rho, o.delta, o.fault_reach})
    check(std::isfinite(length) && length >= 0.0,
          "The voxel size, rho, delta and the fault reach must "
          "be positive, or 0 to have them estimated.");
  check(std::isfinite(o.distance_limit), "The distance to ignore must be a finite number.");
  check(std::isfinite(o.iso_level), "The iso level must be a finite number.");
  check(o.flip_angle >= 0.0 && o.flip_angle <= 180.0, "The flip angle must be 0 to 180 degrees.");
  check(std::isfinite(o.box_extension) && o.box_extension > -1.0,
        "The extension of the grid must be more than -1, which would leave no box at all.");
  check(o.blend >= 1, "A value of the field must be averaged over 1 plane or more.");
  check(o.snap >= 0.0 && o.snap <= 0.4, "The snap fraction must be 0 to 0.4.");
  for (const int cells : o.resolution)
    check(cells >= 0, "The grid resolution must be positive.");
}

bool threeDistinct(const Points& points) {
  const auto other = std::find_if(points.begin(), points.end(),
                                  [&](const Vector3& p) { return p != points.front(); });
  return std::any_of(other, points.end(),
                     [&](const Vector3& p) { return p != points.front() && p != *other; });
}

Bounds boxOf(const Points& points, double extension) {
  Bounds box = boundsOf(points);
  const Vector3 margin = 0.5 * extension * box.size();
  box.low -= margin;
  box.high += margin;
  return box;
}

double voxelSize(const NeighborGrid& grid, const Bounds& box, const HoppeSurfaceOptions& options) {
  double h = options.voxel_size;
  for (int axis = 0; axis < 3 && options.voxel_size == 0.0; ++axis)
    if (options.resolution[static_cast<std::size_t>(axis)] > 0)
      h = std::max(h, box.size()[axis] / options.resolution[static_cast<std::size_t>(axis)]);
  if (h == 0.0)
    h = meanPickDistance(grid, options.threads);
  check(h > 0.0 && std::isfinite(h), "No voxel size can be found; set one.");
  return h;
}

void dropOutside(CutMesh& cut, const Bounds& box) {
  std::vector<Triangle>& triangles = cut.mesh.triangles;
  const auto outside = [&](const Triangle& t) {
    return std::none_of(t.begin(), t.end(), [&](Index v) {
      const Vector3& p = cut.mesh.vertices[static_cast<std::size_t>(v)];
      return (p.array() >= box.low.array()).all() && (p.array() <= box.high.array()).all();
    });
  };
  triangles.erase(std::remove_if(triangles.begin(), triangles.end(), outside), triangles.end());
  removeUnreferencedVertices(cut);
}

/// Fills in what is to be estimated. \return the distance of Hoppe's boundary test
double boundaryDistance(const NeighborGrid& grid, const HoppeSurfaceOptions& options,
                        HoppeSurface& result) {
  result.rho = options.rho;
  result.delta = options.delta;
  if (options.distance_limit > 0.0)
    return options.distance_limit;
  if (options.rho == 0.0 || options.delta == 0.0) {
    const Sampling sampling = estimateSampling(grid, options.threads);
    result.rho = options.rho > 0.0 ? options.rho : sampling.rho;
    result.delta = options.delta > 0.0 ? options.delta : sampling.delta;
  }
  return result.rho + result.delta;
}

SignedDistanceOptions fieldOptions(const NeighborGrid& grid, double boundary, double h,
                                   const HoppeSurfaceOptions& options, bool faulted) {
  SignedDistanceOptions o;
  o.rho_plus_delta = boundary;
  o.overhang = options.distance_limit > 0.0 ? boundary : surface_defaults::kFieldReach * h;
  o.fault_reach = options.fault_reach;
  if (o.fault_reach == 0.0 && faulted)
    o.fault_reach = std::max(6.0 * meanPickDistance(grid, options.threads), 2.0 * boundary);
  // Values are asked for within a cell's diagonal of the surface, which lies the iso level away.
  o.voxel_size = h + std::abs(options.iso_level) / std::sqrt(3.0);
  o.blend = options.blend;
  return o;
}

ExtractionOptions extractionOptions(double h, const HoppeSurfaceOptions& options) {
  ExtractionOptions o;
  o.lattice.voxel_size = h;
  o.lattice.origin = h * surface_defaults::latticeShift();
  o.iso_level = options.iso_level;
  o.flip_angle = options.flip_angle;
  o.snap = options.snap;
  o.threads = options.threads;
  o.memory_limit = options.memory_limit > 0 ? options.memory_limit : defaultMemoryLimit();
  return o;
}

/// Picks on the wrong side of a fault would carry their sheet on through it: they get no plane.
void setWrongSideAside(const NeighborGrid& grid, const FaultNetwork& faults, unsigned threads, TangentPlanes& planes) {
  if (faults.empty())
    return;
  WrongSideOptions o;
  o.threads = threads;
  const WrongSideResult found = findWrongSidePicks(grid, faults, o);
  for (std::size_t i = 0; i < planes.normals.size(); ++i)
    if (found.reasons[i] != PickReason::Good)
      planes.normals[i].setConstant(std::numeric_limits<double>::quiet_NaN());
}

/// Normals that were turned towards a viewpoint change their side where the surface runs through it, or from pick to pick: in both cases neighbours
/// oppose each other, which on an oriented surface none does.
void warnOfFlippedNormals(const NeighborGrid& grid, const Points& normals, unsigned threads, std::vector<std::string>& warnings) {
  constexpr double kOpposed = -0.5;       // 120 degrees
  constexpr double kFewest = 3.0;         // by chance, in noise
  constexpr double kShareOfEdge = 0.1;    // of the points in a row across the cloud
  constexpr std::size_t kGrain = 1 << 12;
  std::vector<std::size_t> blocks((normals.size() + kGrain - 1) / kGrain);
  parallelBlocks(normals.size(), kGrain, threads, [&](std::size_t begin, std::size_t end) {
    std::vector<Neighbor> near;
    for (std::size_t i = begin; i < end; ++i) {
      grid.nearest(grid.points()[i], 2, near);
      const bool opposed = std::any_of(near.begin(), near.end(), [&](const Neighbor& n) {
        return normals[i].dot(normals[static_cast<std::size_t>(n.index)]) < kOpposed;
      });
      blocks[begin / kGrain] += opposed ? 1 : 0;
    }
  });
  const std::size_t opposed = std::accumulate(blocks.begin(), blocks.end(), std::size_t{0});
  if (static_cast<double>(opposed) > std::max(kFewest, kShareOfEdge * std::sqrt(static_cast<double>(normals.size()))))
    warnings.push_back("The normals of " + std::to_string(opposed) + " points oppose that of the point next to them, so triangles face both ways: they were "
                       "turned towards a viewpoint, as pcl::NormalEstimation does. FaultConstrainedNormalEstimation turns them along the surface.");
}

/// What vertices take their fields from: the points that have a plane.
std::vector<Index> donors(const CutMesh& cut, const Points& points, const TangentPlanes& planes, const FaultNetwork& faults, unsigned threads) {
  Points good = points;
  for (std::size_t i = 0; i < good.size(); ++i)
    if (!planes.normals[i].allFinite())
      good[i] = planes.normals[i];
  return picksOfVertices(cut, VertexCorners(cut.mesh), NeighborGrid(good, 0.0, threads), faults, threads);
}

bool touchesFault(const CutMesh& cut) {
  return std::any_of(cut.vertex_faults.begin(), cut.vertex_faults.end(), [](const std::array<Index, 2>& f) { return f[0] >= 0; });
}

} // namespace

HoppeSurface hoppeSurface(const Points& points, const Points& normals, const FaultNetwork& faults,
                          const HoppeSurfaceOptions& options) {
  checkOptions(options);
  check(threeDistinct(points), "There must be three distinct points with normals or more.");
  HoppeSurface result;
  const NeighborGrid grid(points, 0.0, options.threads);
  const Bounds box = boxOf(points, options.box_extension);
  const double boundary = boundaryDistance(grid, options, result);
  const double h = result.voxel_size = voxelSize(grid, box, options);

  TangentPlanes planes;
  planes.centres = points;
  planes.normals = normals;
  setWrongSideAside(grid, faults, options.threads, planes);
  const SignedDistance field(grid, planes, faults,
                             fieldOptions(grid, boundary, h, options, !faults.empty()));
  SheetMesh sheets = extractSheets(field, extractionOptions(h, options));
  result.cells = sheets.cells;
  result.rejected_by_flip_angle = sheets.rejected_by_flip_angle;

  if (!(options.distance_limit > 0.0)) {
    DataBorderOptions border;
    border.overhang = surface_defaults::kOverhang * h;
    border.threads = options.threads;
    border.iso_level = options.iso_level;
    trimToData(sheets, field, border);
  }

  FaultCutOptions cutting;
  cutting.tolerance = 0.02 * h; // no fit follows that would bring back what is moved onto a fault
  cutting.threads = options.threads;
  result.cut = cutSheets(std::move(sheets), faults, cutting);
  removeCrumbs(result.cut, options.smallest_piece);
  if (options.box_extension < 0.0)
    dropOutside(result.cut, box);
  check(!result.cut.mesh.empty(),
        "No surface was found: the points are too sparse for the voxel size, "
        "or rho, delta or the distance to ignore are too small.");
  computeVertexNormals(result.cut.mesh, options.threads);
  warnOfFlippedNormals(grid, normals, options.threads, result.warnings);
  if (!touchesFault(result.cut))
    if (std::string odd = faultsWithoutEffect(faults, boundsOf(result.cut.mesh.vertices), "surface"); !odd.empty())
      result.warnings.push_back(std::move(odd));
  if (options.find_picks)
    result.picks = donors(result.cut, points, planes, faults, options.threads);
  return result;
}

} // namespace graben
