#include "graben/surface/zone_fit.h"

#include "local/box_around.h"
#include "local/local_faults.h"
#include "cut/vertex_moves.h"

#include "graben/core/threads.h"
#include "graben/mesh/normals.h"
#include "graben/surface/quadric.h"
#include "graben/surface/viewpoints.h"

#include <algorithm>
#include <cmath>

namespace graben {

namespace {

class ZoneFitter {
public:
  ZoneFitter(const CutMesh& cut, const VertexCorners& corners, const NeighborGrid& grid, const TangentPlanes& planes, const FaultNetwork& faults,
             const ZoneFitOptions& options)
    : cut_(cut), grid_(grid), planes_(planes), faults_(faults), borders_(faults), options_(options), viewpoints_(cut, corners) {}

  struct Scratch {
    std::vector<Neighbor> candidates;
    Points seen; ///< the picks, and where they are looked at from
  };

  /// The new position of a vertex; false if it has too few picks.
  bool fit(Index vertex, Vector3& position, Scratch& scratch) const {
    const auto v = static_cast<std::size_t>(vertex);
    const Vector3& at = cut_.mesh.vertices[v];
    Quadric sum;
    if (addPicks(at, viewpoints_.of(vertex), sum, scratch) < 3)
      return false;
    addFaults(vertex, at, sum);
    Vector3 step = sum.minimizer(options_.relative_cutoff);
    if (options_.mode == FitMode::Normal && !cut_.onFault(vertex)) {
      const Vector3& n = cut_.mesh.normals[v];
      step = step.dot(n) * n;
    }
    const double length = step.norm();
    if (options_.max_step > 0.0 && length > options_.max_step)
      step *= options_.max_step / length;
    position = ontoFaults(faults_, cut_.vertex_faults[v], at + step);
    return true;
  }

private:
  std::size_t addPicks(const Vector3& at, const Vector3& viewpoint, Quadric& sum, Scratch& scratch) const {
    std::vector<Neighbor>& candidates = scratch.candidates;
    const double radius = options_.search_radius > 0.0 ? options_.search_radius : std::numeric_limits<double>::infinity();
    std::size_t used = 0;
    for (std::size_t count = 2 * options_.neighbors;; count *= 4) {
      sum = Quadric();
      used = 0;
      grid_.nearest(viewpoint, count, candidates, radius);
      if (candidates.empty())
        return 0;
      const LocalFaults sides = faultsAmong(candidates, viewpoint, scratch.seen);
      for (const Neighbor& c : candidates) {
        const auto i = static_cast<std::size_t>(c.index);
        const Vector3& n = planes_.normals[i];
        if (!(n.x() == n.x()) || (!sides.empty() && !sides.sameSide(grid_.points()[i], viewpoint)))
          continue;
        sum.addPlane(grid_.points()[i] - at, n);
        if (++used == options_.neighbors)
          return used;
      }
      if (candidates.size() < count || count > 64 * options_.neighbors)
        return used;
    }
  }

  /// What parts some picks from where they are looked at.
  LocalFaults faultsAmong(const std::vector<Neighbor>& picks, const Vector3& viewpoint, Points& seen) const {
    seen.assign(1, viewpoint);
    for (const Neighbor& pick : picks)
      seen.push_back(grid_.points()[static_cast<std::size_t>(pick.index)]);
    if (!faults_.mayPart(seen))
      return {};
    Bounds box;
    for (const Vector3& p : seen)
      box.extend(p);
    return {faults_, borders_, box};
  }

  void addFaults(Index vertex, const Vector3& at, Quadric& sum) const {
    for (const Index f : cut_.vertex_faults[static_cast<std::size_t>(vertex)]) {
      if (f < 0)
        continue;
      const FaultPoint p = faults_.nearest(static_cast<std::size_t>(f), at);
      sum.addPlane(p.point - at, p.normal, 10.0 * static_cast<double>(options_.neighbors));
    }
  }

  const CutMesh& cut_;
  const NeighborGrid& grid_;
  const TangentPlanes& planes_;
  const FaultNetwork& faults_;
  FaultBorders borders_;
  const ZoneFitOptions& options_;
  Viewpoints viewpoints_;
};

std::vector<Index> zoneVertices(const CutMesh& cut, const FaultNetwork& faults, const ZoneFitOptions& options) {
  std::vector<std::uint8_t> in(cut.mesh.vertices.size(), 0);
  const bool all = std::isinf(options.zone_width);
  parallelBlocks(in.size(), 64, options.threads, [&](std::size_t begin, std::size_t end) { // vertices that follow each other lie together
    Bounds box;
    for (std::size_t v = begin; v < end; ++v)
      box.extend(cut.mesh.vertices[v]);
    if (!all && !faults.mayTouch(grown(box, 1.001 * options.zone_width)))
      return;
    for (std::size_t v = begin; v < end; ++v)
      in[v] = all || faults.nearest(cut.mesh.vertices[v], options.zone_width).fault >= 0 ? 1 : 0;
  });
  std::vector<Index> zone;
  for (std::size_t v = 0; v < in.size(); ++v)
    if (in[v] != 0)
      zone.push_back(static_cast<Index>(v));
  return zone;
}

} // namespace

ZoneFitResult fitZone(CutMesh& cut, const NeighborGrid& grid, const TangentPlanes& planes, const FaultNetwork& faults,
                      const ZoneFitOptions& options) {
  return fitZone(cut, VertexCorners(cut.mesh, options.threads), grid, planes, faults, options);
}

ZoneFitResult fitZone(CutMesh& cut, const VertexCorners& corners, const NeighborGrid& grid, const TangentPlanes& planes, const FaultNetwork& faults,
                      const ZoneFitOptions& options) {
  ZoneFitResult result;
  if (options.mode == FitMode::Off)
    return result;
  const std::vector<Index> zone = zoneVertices(cut, faults, options);
  const VertexMover mover(cut, corners, faults, options.threads);
  cut.mesh.normals.resize(cut.mesh.vertices.size(), Vector3::UnitZ());
  for (unsigned pass = 0; pass < options.passes; ++pass) {
    updateVertexNormals(cut.mesh, corners, zone, options.threads);
    const ZoneFitter fitter(cut, corners, grid, planes, faults, options);
    Points targets = mover.places(cut);
    std::vector<std::uint8_t> done(zone.size(), 0);
    parallelBlocks(zone.size(), 64, options.threads, [&](std::size_t begin, std::size_t end) {
      ZoneFitter::Scratch scratch;
      Vector3 position;
      for (std::size_t i = begin; i < end; ++i)
        if (fitter.fit(zone[i], position, scratch)) {
          mover.send(zone[i], position, cut, targets);
          done[i] = 1;
        }
    });
    mover.move(cut, std::move(targets));
    result.fitted = static_cast<std::size_t>(std::count(done.begin(), done.end(), 1));
    result.without_picks = zone.size() - result.fitted;
  }
  return result;
}

} // namespace graben
