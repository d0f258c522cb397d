#pragma once

#include "band_distances.h"
#include "robust_plane.h"

#include "graben/faults/fault_network.h"
#include "graben/features/neighbor_grid.h"

#include <cstdint>
#include <unordered_map>
#include <vector>

namespace graben::detail {

/// What may be built on a pick.
enum class PickState : std::uint8_t {
  Trusted, ///< farther than the band from every fault, or accepted
  Pending, ///< not judged yet
  Suspect, ///< disagrees with its own sheet
  WrongSide,
  Smeared,
  Doubtful ///< a suspect that nothing explains
};

/// The sheet that a pick belongs to.
struct Home {
  std::uint64_t signature; ///< of the faults between the pick and the sheet; 0: none
  Index example;           ///< a trusted pick of it
};

/// The picks of the job and what is known of them so far.
struct PickField {
  const NeighborGrid& grid;
  const FaultNetwork& faults;
  double mean_distance;
  double scale;                  ///< least deviation to reckon with in robust fits
  double band;                   ///< distance to faults up to which picks are judged
  BandDistances distances;       ///< to the nearest fault; infinite beyond the band
  std::vector<PickState> states;
  std::unordered_map<std::size_t, Home> homes; ///< of the wrong-side picks found so far

  /// What is known of a pick's own sheet: its signature seen from the pick, and a trusted pick of it.
  Home home(std::size_t pick) const {
    return states[pick] == PickState::WrongSide ? homes.at(pick) : Home{0, static_cast<Index>(pick)};
  }
};

/// A place that picks are looked at from.
struct Viewpoint {
  Vector3 at;
  double clearance; ///< there is no fault nearer than this
};

/// A surface on the other side of one or more faults, continued to a viewpoint.
struct SheetBeyond {
  std::uint64_t signature; ///< of the faults in between
  Index example;           ///< a trusted pick of it
  PlaneAt plane;
};

/// Collects the picks that planes are fitted to. One per thread.
class PickSupport {
public:
  explicit PickSupport(const PickField& field)
      : field_(field) {}

  /// The nearest trusted picks on the side of \a viewpoint.
  PlaneAt ownPlane(const Viewpoint& viewpoint);
  /// The nearest suspects on that side.
  PlaneAt suspectPlane(const Viewpoint& viewpoint);
  /// Trusted picks with pending ones too, those far from faults weighing most.
  PlaneAt consensusPlane(const Viewpoint& viewpoint);
  /// The surface beside \a query, from the nearest picks on its side at least \a gap farther in a
  /// direction.
  PlaneAt planeBeside(const Viewpoint& query, const Vector3& direction, double gap, double radius);

  /// All sheets that faults hide from \a viewpoint, nearest first, from trusted picks and those
  /// already found to belong to them.
  std::vector<SheetBeyond> sheetsBeyond(const Viewpoint& viewpoint);

private:
  template <typename Weigh>
  PlaneAt plane(const Viewpoint& viewpoint, double radius, const Weigh& weightOf);
  template <typename Weigh>
  void collect(const Vector3& place, double radius, const Weigh& weightOf);

  std::uint64_t faultsBefore(const Viewpoint& viewpoint, std::size_t pick) const;

  const PickField& field_;
  std::vector<PointRun> runs_;
  std::vector<Neighbor> candidates_;
  std::vector<WeightedPoint> chosen_;
};

} // namespace graben::detail
