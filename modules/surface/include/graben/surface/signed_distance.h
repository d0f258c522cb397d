#pragma once

#include "graben/core/export.h"
#include "graben/features/tangent_planes.h"
#include "graben/faults/fault_signature.h"

#include <limits>
#include <memory>
#include <vector>

GRABEN_EXPORT_BEGIN
namespace graben {

class FaultBorders;
struct FieldData;
struct FieldNeighborhood;
struct PlaneBlend;
class NearbyPicks;

struct SignedDistanceOptions {
  double rho_plus_delta = 0.0; ///< the field is undefined where its foot lies farther than this from the data (Hoppe 1992, section 3.4)
  double overhang = 0.0;       ///< farthest the foot may lie beyond the data's edge; 0: rho_plus_delta. Inside a sparse patch, where picks lie
                               ///< all round, rho_plus_delta holds
  double fault_reach = 0.0;    ///< farthest the field is carried from the last pick towards a fault, inside the outline of the picks of both sides
                               ///< or, where one side has none, where picks and faults close a ring; 0: no farther than elsewhere
  double voxel_size = 1.0;     ///< h: values are asked for within one cell's diagonal of the surface
  double widest_gap = 150.0;   ///< degrees between the directions to the picks around a place that is inside the data
  std::size_t blend = 1;       ///< planes a value is averaged over; 1: Hoppe's nearest plane alone
};

/// The field's value at a place.
struct FieldValue {
  double value = std::numeric_limits<double>::quiet_NaN(); ///< signed distance, NaN where the field is undefined
  Index plane = -1;                                        ///< pick whose tangent plane is nearest, -1 if none is in reach
  bool defined() const { return value == value; }
};

/// Hoppe's signed distance f(v) = (v - o) . n, seen from one side of the faults.
///
/// Beyond the paper: a value at v is asked for as seen from a viewpoint; only picks that no fault hides from there take part. Seen from v itself that
/// is the field of v's own side; seen from a place on the other side of a fault it is that side's field, carried on through the fault.
/// Thread-safe; holds references to what it is made from.
class SignedDistance {
public:
  SignedDistance(const NeighborGrid& grid, const TangentPlanes& planes, const FaultNetwork& faults,
                 const SignedDistanceOptions& options);

  /// Buffers of one thread, and what lies around the places it asks about.
  struct Scratch {
    Scratch();
    ~Scratch();
    std::vector<Neighbor> candidates;
    std::vector<Neighbor> visible;
    PointsAround picks;
    std::unique_ptr<FieldNeighborhood> around;
  };

  FieldValue at(const Vector3& v, const Vector3& viewpoint, Scratch& scratch) const;

  /// The values at many places in a box of a few cells, together at a fraction of the cost.
  /// \param[in] viewpoints one for each place
  /// \param[out] values one for each place
  void at(const Points& places, const Points& viewpoints, Scratch& scratch, std::vector<FieldValue>& values) const;

  /// How far a place on the surface lies from the nearest pick; 0 if that is within \a near, if picks lie all round it, or if it lies near a fault and
  /// no farther than \a near outside the outline of the picks of both sides.
  /// \param[in] viewpoint from where it is asked which picks count: the place itself, or a place on the sheet's own side
  double distanceBeyond(const Vector3& place, const Vector3& viewpoint, const Vector3& normal, double near, Scratch& scratch) const;

  const SignedDistanceOptions& options() const { return options_; }
  const FaultNetwork& faults() const { return faults_; }
  const FaultBorders& borders() const { return *borders_; }
  const TangentPlanes& planes() const { return planes_; }
  const NeighborGrid& grid() const { return grid_; }

private:
  void findVisible(const Vector3& v, const Vector3& viewpoint, Scratch& scratch) const;
  void findVisibleInGrid(const Vector3& v, const Vector3& viewpoint, Scratch& scratch) const;
  bool findVisibleNearby(const Vector3& v, const Vector3& viewpoint, Scratch& scratch) const;
  bool supported(const Vector3& v, const Vector3& foot, const Vector3& viewpoint, Scratch& scratch) const;
  bool surrounded(const Vector3& foot, const Vector3& normal, Scratch& scratch) const;
  bool enclosed(const Vector3& place, const Vector3& normal, Scratch& scratch) const;
  bool insideOutline(const Vector3& place, const Vector3& normal, double near, Scratch& scratch) const;
  bool carriedToFault(const Vector3& foot, double near, Scratch& scratch) const;
  FieldValue valueOf(const Vector3& v, const Vector3& viewpoint, Scratch& scratch) const;
  void valuesOf(const Vector3* places, const Vector3* viewpoints, std::size_t count, Scratch& scratch, FieldValue* values) const;
  unsigned blendTogether(const double* reaches, const NearbyPicks& near, PlaneBlend& blend, FieldValue* values) const;
  unsigned blendWider(const Vector3* places, const Vector3* viewpoints, std::size_t count, unsigned done, Scratch& scratch, FieldValue* values) const;
  void gatherFar(FieldNeighborhood& around) const;
  double sureReach(const Vector3& v, const FieldNeighborhood& around) const;
  bool enough(const std::vector<Neighbor>& visible, double reach) const;
  FieldData data() const;
  void focus(const Bounds& places, Scratch& scratch) const;
  void focusFaults(const Bounds& places, Scratch& scratch) const;
  FieldValue blended(const Vector3& v, const std::vector<Neighbor>& visible, Vector3& foot) const;

  const NeighborGrid& grid_;
  const TangentPlanes& planes_;
  const FaultNetwork& faults_;
  SignedDistanceOptions options_;
  std::shared_ptr<const FaultBorders> borders_;
  double query_radius_ = 0.0;
  double usual_reach_ = 0.0; ///< within which the picks for a value mostly are
};

} // namespace graben
GRABEN_EXPORT_END
