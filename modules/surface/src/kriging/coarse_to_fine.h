#pragma once

#include "graben/features/neighbor_grid.h"

#include <vector>

namespace graben::detail {

/// Places in an order in which each is the one farthest from all before it, as far as they have been taken.
class CoarseToFine {
public:
  /// Takes all of them. O(n log n) where they lie evenly. \param[in] normals unit, of each
  CoarseToFine(Points places, Points normals);

  /// The place in order: which one it is.
  const std::vector<std::size_t>& order() const { return order_; }

  /// Those before one in the order that are nearest to it, from near to far, of about its own normal; the order's numbers are to be asked for in rising order.
  /// \param[in] at number in the order \param[in] most how many, if there are as many
  const std::vector<std::size_t>& nearestBefore(std::size_t at, std::size_t most);

private:
  void arrange();
  void takeIn(std::size_t at);
  void collect(std::size_t at, double radius);

  Points places_;
  Points normals_;
  std::vector<std::size_t> order_;
  std::vector<double> way_; ///< of each in the order to the nearest before it
  double extent_ = 0.0;
  Points first_;            ///< the coarsest ones, twice as many as have been asked for or fewer
  NeighborGrid grid_;       ///< on these
  PointsAround around_;
  std::vector<std::pair<double, std::size_t>> found_; ///< squared distance, and which
  std::vector<std::size_t> nearest_;
};

} // namespace graben::detail
