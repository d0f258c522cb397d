#pragma once

#include "support_kernels.h"

#include <memory>
#include <vector>

namespace graben::detail {

/// Picks that follow each other in memory.
struct PickRun {
  const double* points; ///< x y z x y z ...; coordinates that are not finite may stand among them
  std::size_t count;
  const std::int32_t* indices; ///< of the picks; null: first, first + 1, ...
  std::int32_t first;
};

/// Which picks are collected, and the frame they are then given in: u, v and normal are unit axes.
struct DiscQuery {
  std::array<double, 3> centre, u, v, normal;
  double squared_radius;
  double least_cosine; ///< between a pick's normal and the frame's
};

/// A few picks that follow each other.
struct PickBlock {
  static constexpr std::size_t kSize = 8;
  double x[kSize], y[kSize], z[kSize], normal_x[kSize], normal_y[kSize], normal_z[kSize];
  std::int32_t index[kSize];
};

/// The boxes around kLanes blocks.
struct BlockBoxes {
  double low[3][kLanes], high[3][kLanes];
};

/// Picks copied into small blocks, those that follow each other together, for many questions which of them lie around a place.
///
/// Picks that follow each other should lie near each other. A question costs a fraction of a nanosecond for each pick and a few for each near the place.
class PickBlocks {
public:
  /// Leaves none. \param[in] room picks that may be added
  void clear(std::size_t room);

  /// \param[in] normals of all picks: x y z x y z ...
  void add(const PickRun& run, const double* normals);

  /// To be called behind the last add(), before the first question.
  void close();

  /// Finds the blocks within a distance of a place. \return how many picks they hold together, at most
  std::size_t findNear(const std::array<double, 3>& place, double squared_distance);

  /// The picks of the blocks found that lie within the radius and face the right way, in the order they were added.
  /// \param[out] out with room for as many as there are in the blocks, and kLanes more
  /// \return how many there are
  std::size_t collect(const DiscQuery& query, const PickArrays& out) const;

private:
  std::size_t count_ = 0; ///< picks; the arrays may be longer
  std::unique_ptr<PickBlock[]> blocks_;
  std::size_t capacity_ = 0; ///< blocks
  std::vector<BlockBoxes> boxes_;  ///< of the blocks
  std::vector<BlockBoxes> around_; ///< around kLanes of these each
  std::size_t around_count_ = 0;
  std::vector<std::int32_t> near_;
  std::size_t near_count_ = 0;
};

} // namespace graben::detail
