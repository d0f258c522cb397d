#pragma once

#include "local/local_faults.h"
#include "patch_lanes.h"

#include "graben/surface/local_fit.h"

#include <cstdint>

namespace graben::detail {

/// Puts a piece of surface into one of the lanes. \param[in] centre of its picks \param[in] reach about it
void setLane(const LocalSurface& surface, const Vector3& centre, double reach, std::size_t lane, PatchLanes& lanes);

/// Fitted pieces of surface spread evenly over the picks, each about a pick of its own, which overlap so that every place among the picks has a few:
/// their weighted mean is the surface there, smooth from place to place, at a fraction of the cost of a fit of its own for every place.
///
/// Thread-safe after construction; holds references. The cost of building them is in proportion to the picks, whatever the supports.
class SurfacePatches {
public:
  /// \param[in] near_distance picks within this distance of a fault take the near model
  SurfacePatches(const LocalFit& fit, const ModelChoice& models, double near_distance, unsigned threads);

  /// Whether a support is so wide that patches cost less than a fit for every place: otherwise what there is to see is as small as the support, and
  /// patches would blur it. No patches are made of such a model.
  static bool worthwhile(const LocalModel& model) { return model.neighbors > 45; }

  /// What lies near a block of places: working memory, kept by the caller from block to block.
  struct Block {
    std::vector<Index> patches;    ///< that may reach a place of the block
    std::vector<PatchLanes> lanes; ///< the same, as many at a time
    LocalFaults faults;
    PointsAround around;
  };

  /// Makes ready for places in a box. The smaller the box in comparison to reach(), the cheaper.
  void gather(const Bounds& box, Block& block) const;

  struct Estimate : LocalEstimate {
    std::size_t narrower = 0; ///< picks of the support that the place needs, where the surface bends more sharply than elsewhere; 0: the patches do
  };

  /// The patches' surface as seen from a place of the block along a unit direction; not valid where none reaches.
  /// \param[in] viewpoint from where it is asked which patches lie on the same side of the faults
  Estimate at(const Vector3& place, const Vector3& viewpoint, const Vector3& direction, const Block& block) const;

  /// Distance to which the widest patch is used.
  double reach() const { return widest_; }

private:
  std::size_t lookAround(std::size_t patch, std::size_t end, LocalFit::Scratch& scratch) const;
  void setLanes(Block& block) const;
  void choosePicks(const ModelChoice& models, double near_distance, unsigned threads);

  const LocalFit& fit_;
  std::vector<Index> picks_;
  std::vector<LocalModel> models_;
  std::vector<std::uint8_t> is_near_;
  std::vector<std::uint16_t> narrower_; ///< support that suits better, 0: the patch's own
  std::vector<LocalSurface> patches_;
  Points centres_; ///< of each patch's picks; NaN where there is no patch
  NeighborGrid grid_;
  double widest_ = 0.0; ///< reach of the widest patch
};

} // namespace graben::detail
