#pragma once

#include "graben/core/export.h"
#include "graben/faults/fault_network.h"

#include <cstdint>
#include <vector>

GRABEN_EXPORT_BEGIN
namespace graben {

/// The parallel planes that hold each fault where it passes through a box: a cheap way to see that no fault lies between two places in that box, for those
/// who ask about many. To be kept and used again by one thread; copies nothing of the faults.
class FaultSlabs {
public:
  /// On which sides of all slabs a place is: two bits a slab, the lower one above it, the upper one below it, none within it.
  using Mark = std::uint32_t;

  /// Sets the slabs of the faults in \a box and slightly beyond. O(log n + triangles there).
  void gather(const FaultNetwork& faults, const Bounds& box);

  /// No fault touches the box.
  bool empty() const { return slabs_.empty(); }
  /// The mark of a place in the box.
  Mark mark(const Vector3& p) const {
    Mark mark = 0;
    for (std::size_t s = slabs_.size(); s-- > 0;) {
      const double at = slabs_[s].normal.dot(p);
      mark = (mark << 2) | (at > slabs_[s].high ? 1U : 0U) | (at < slabs_[s].low ? 2U : 0U);
    }
    return mark;
  }
  /// True if no segment between places in the box meets a fault. \param[in] common the bits that the marks of all of them have
  bool clear(Mark common) const { return ((common | (common >> 1)) & kLower & all_) == all_; }
  /// True if two places lie on opposite sides of a slab, as those do that have a fault between them as a rule.
  static bool opposite(Mark a, Mark b) { return (((a & (b >> 1)) | ((a >> 1) & b)) & kLower) != 0; }

private:
  static constexpr Mark kLower = 0x55555555U;

  struct Slab {
    Vector3 normal;
    double low, high; ///< the fault lies between these along the normal
  };
  static Slab slabOf(const TriangleMesh& mesh, const std::vector<Index>& triangles, const Bounds& box, double rounding);

  std::vector<Slab> slabs_;
  std::vector<Index> triangles_;
  std::vector<std::size_t> near_;
  Mark all_ = 0; ///< the lower bit of each slab
};

} // namespace graben
GRABEN_EXPORT_END
