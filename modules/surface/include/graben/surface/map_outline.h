#pragma once

#include "graben/core/export.h"
#include "graben/core/types.h"
#include "graben/surface/sheet_extraction.h"

#include <vector>

GRABEN_EXPORT_BEGIN
namespace graben {

/// An area of the map (x and y; z is not looked at), bounded by rings: a place in an odd number of them is inside. Thread-safe to ask.
class MapOutline {
public:
  MapOutline() = default;
  /// \param[in] rings three places or more each, the last one joined to the first; places that are not finite are passed over
  explicit MapOutline(const std::vector<Points>& rings);

  /// The convex hull of points on the map; empty if they are on a line. Those that are not finite are passed over.
  static MapOutline hullOf(const Points& points);

  bool empty() const { return rings_.empty(); }

  /// How far a place is beyond the outline, in the points' units; less than 0 inside. O(edges)
  double beyond(const Vector3& place) const;

  const std::vector<Points>& rings() const { return rings_; }

private:
  std::vector<Points> rings_; ///< with z 0
};

/// Ends a surface where it leaves an area of the map; triangles across the outline are split. \param[in] overhang how far beyond it the surface may reach,
/// in the points' units. Deterministic for any number of threads. O(vertices x edges)
void clipToOutline(SheetMesh& sheets, const MapOutline& outline, double overhang, unsigned threads = 0);

} // namespace graben
GRABEN_EXPORT_END
