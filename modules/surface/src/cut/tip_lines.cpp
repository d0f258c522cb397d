#include "tip_lines.h"

#include "graben/mesh/adjacency.h"

#include <algorithm>
#include <cmath>

namespace graben::detail {

namespace {

constexpr double kMostPerEdge = 1e4;
constexpr double kShortOf = 0.98; // of the way to a tip: what lies before it hides it, the fault that ends there does not

} // namespace

TipLines::TipLines(const FaultNetwork& faults, const NeighborGrid& grid, double spacing, double reach) : faults_(faults) {
  for (std::size_t f = 0; f < faults.size(); ++f) {
    const TriangleMesh& mesh = faults.fault(f).mesh;
    const EdgeAdjacency adjacency(mesh);
    for (std::size_t h = 0; h < 3 * mesh.triangles.size(); ++h) {
      if (!adjacency.isBorder(static_cast<Index>(h)))
        continue;
      const Triangle& t = mesh.triangles[h / 3];
      const Vector3& a = mesh.vertices[static_cast<std::size_t>(t[h % 3])];
      const Vector3 run = mesh.vertices[static_cast<std::size_t>(t[(h + 1) % 3])] - a;
      const double steps = std::clamp(std::ceil(run.norm() / spacing), 1.0, kMostPerEdge);
      for (double s = 0.0; s < steps; ++s) {
        const Vector3 place = a + s / steps * run;
        if (grid.nearestOne(place, reach).index >= 0)
          places_.push_back(place);
      }
    }
  }
  grid_ = NeighborGrid(places_);
}

double TipLines::distance(const Vector3& place, double limit) const {
  const Neighbor nearest = grid_.nearestOne(place, limit);
  if (nearest.index < 0)
    return limit;
  const Vector3& tip = places_[static_cast<std::size_t>(nearest.index)];
  return faults_.crosses(place, place + kShortOf * (tip - place)) ? limit : std::sqrt(nearest.squared_distance);
}

bool TipLines::mayReach(const Bounds& box, double limit) const {
  return grid_.nearestOne(0.5 * (box.low + box.high), 1.001 * (limit + 0.5 * box.diagonal())).index >= 0;
}

} // namespace graben::detail
