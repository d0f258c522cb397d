#pragma once

#include "graben/faults/fault_network.h"
#include "graben/features/neighbor_grid.h"

#include <map>
#include <tuple>
#include <vector>

namespace graben::detail {

/// A stretch along strike on one side of a fault.
struct ShadowBin {
  std::size_t picks = 0; ///< of those looked at
  double nearest = 0.0;  ///< distance of its nearest pick to the fault
  Index pick = -1;       ///< which one that is
  double near = 0.0;     ///< distance within which it would say that there is no shadow
};

/// A pick beside a fault, and the bin it is in.
struct PickBesideFault {
  Index pick = -1;
  FaultPoint near; ///< of the nearest fault
  int bin = 0;
};

/// Picks beside faults, sorted into stretches along strike.
class ShadowBins {
public:
  /// \param[in] near  distance to a fault within which a pick says that there is no shadow
  /// \param[in] limit farthest picks that count
  ShadowBins(const NeighborGrid& grid, const FaultNetwork& faults, double length, double near, double limit, unsigned threads);

  /// The width of the shadow where a pick lies; 0 if there is none, or no pick on the other side.
  double widthAt(const PickBesideFault& pick) const;
  /// The widths of the shadow along one side of a fault, and in how many bins picks lie at all.
  std::vector<double> widths(Index fault, int side, std::size_t& bins) const;
  /// 0: no shadow at all
  double widest() const { return widest_; }

  /// All picks beside faults, those nearest to a fault's border too, that are within the distance and where they lie; in the grid's order.
  std::vector<PickBesideFault> picksWithin(double distance) const;

private:
  using Key = std::tuple<Index, int, int>;

  PickBesideFault beside(Index pick, double limit) const;
  void addSample();
  void addNear();
  void refine();
  void measureWidest();
  bool open(const ShadowBin& bin) const;
  static void take(const PickBesideFault& pick, ShadowBin& bin);
  bool hasPicks(Index fault, int side, int bin) const;

  const NeighborGrid& grid_;
  const FaultNetwork& faults_;
  double length_;
  double near_;
  double limit_;
  unsigned threads_;
  std::vector<Vector3> strikes_; ///< of each fault
  std::map<Key, ShadowBin> bins_;
  double widest_ = 0.0;
};

} // namespace graben::detail
