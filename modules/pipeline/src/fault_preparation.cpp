#include "fault_preparation.h"

#include "graben/core/errors.h"
#include "graben/core/threads.h"
#include "graben/faults/extension.h"

#include <algorithm>
#include <cmath>

namespace graben {

namespace {

/// The frame to read a fault in: its own z direction where its file says one, the picks' otherwise.
Vector3 toLocal(const Vector3& p, ZPositive z_positive, const LocalFrame& frame) {
  if (z_positive == ZPositive::Unknown || z_positive == frame.z_positive)
    return frame.toLocal(p);
  return frame.toLocal(Vector3(p.x(), p.y(), -p.z()));
}

LoftedFaults localSurfaces(const FaultGeometry& fault, const LocalFrame& frame, const LoftOptions& options) {
  if (const auto* mesh = std::get_if<TriangleMesh>(&fault.geometry)) {
    TriangleMesh local;
    local.triangles = mesh->triangles;
    local.vertices.reserve(mesh->vertices.size());
    for (const Vector3& p : mesh->vertices)
      local.vertices.push_back(toLocal(p, fault.z_positive, frame));
    return meshedFault(fault.name, local, options);
  }
  std::vector<FaultStick> sticks = std::get<std::vector<FaultStick>>(fault.geometry);
  for (FaultStick& stick : sticks)
    for (Vector3& p : stick.points)
      p = toLocal(p, fault.z_positive, frame);
  return loftFaults(fault.name, sticks, options);
}

constexpr std::size_t kStrayPicks = 8; // beyond an end at the data's edge; inside the data there are several times as many

/// Whether an end of a fault lies at the data's edge: picks on its near side, but hardly any farther along strike. Such an end is no tip.
class EndsAtDataEdge {
public:
  EndsAtDataEdge(const NeighborGrid& picks, const FaultPreparation& options) : picks_(picks), options_(options) {}

  bool operator()(const Points& end, const Points& outward) const {
    Neighbor nearest;
    nearest.squared_distance = options_.extension * options_.extension;
    Vector3 place;
    Vector3 way;
    for (std::size_t i = 0; i + 1 < end.size(); ++i) {
      const Vector3 run = end[i + 1] - end[i];
      const double steps = std::clamp(std::ceil(run.norm() / options_.pick_distance), 1.0, 1e4);
      for (double s = 0.0; s <= steps; ++s) {
        const Vector3 p = end[i] + s / steps * run;
        const Neighbor found = picks_.nearestOne(p, std::sqrt(nearest.squared_distance));
        if (found.index < 0)
          continue;
        nearest = found;
        place = p;
        way = outward[i];
      }
    }
    return nearest.index >= 0 && !dataGoesOn(place, way);
  }

private:
  bool dataGoesOn(const Vector3& place, const Vector3& outward) const {
    std::vector<Neighbor> around;
    picks_.within(place, options_.extension, around);
    const auto beyond = std::count_if(around.begin(), around.end(), [&](const Neighbor& n) {
      return (picks_.points()[static_cast<std::size_t>(n.index)] - place).dot(outward) > options_.pick_distance;
    });
    return beyond > static_cast<std::ptrdiff_t>(kStrayPicks);
  }

  const NeighborGrid& picks_;
  const FaultPreparation& options_;
};

} // namespace

std::vector<FaultSurface> prepareFaults(const std::vector<FaultGeometry>& faults, const LocalFrame& frame, const NeighborGrid& picks,
                                        const FaultPreparation& options, std::vector<std::string>& warnings,
                                        std::vector<std::string>& notes) {
  std::vector<FaultSurface> surfaces;
  for (const FaultGeometry& fault : faults) {
    if (fault.z_positive != ZPositive::Unknown && fault.z_positive != frame.z_positive)
      warnings.push_back("Fault " + fault.name + " has its z the other way up than the picks; it was turned over.");
    LoftedFaults lofted = localSurfaces(fault, frame, options.loft);
    warnings.insert(warnings.end(), lofted.warnings.begin(), lofted.warnings.end());
    notes.insert(notes.end(), lofted.notes.begin(), lofted.notes.end());
    for (FaultSurface& surface : lofted.faults) {
      if (options.extension > 0.0)
        surface = extendedAlongStrike(extendedAlongDip(surface, options.extension), options.extension, EndsAtDataEdge(picks, options));
      surfaces.push_back(std::move(surface));
    }
  }
  return surfaces;
}

TriangleMesh toUserFrame(TriangleMesh local, const LocalFrame& frame, unsigned threads) {
  constexpr std::size_t kGrain = 1 << 14;
  parallelFor(local.vertices.size(), kGrain, threads, [&](std::size_t v) { local.vertices[v] = frame.toUser(local.vertices[v]); });
  parallelFor(local.normals.size(), kGrain, threads, [&](std::size_t v) { local.normals[v] = frame.normalToUser(local.normals[v]); });
  if (frame.mirrors())
    for (Triangle& t : local.triangles)
      std::swap(t[1], t[2]);
  return local;
}

FaultSurface toUserFrame(const FaultSurface& local, const LocalFrame& frame) {
  return {local.name, toUserFrame(local.mesh, frame)};
}

} // namespace graben
