#include "planes/measured_normals.h"

#include "graben/core/errors.h"

#include <algorithm>

namespace graben::detail {

MeasuredNormals::MeasuredNormals(const NeighborGrid& grid, const std::vector<MeasuredNormal>& measured) {
  const Points& points = grid.points();
  std::vector<MeasuredNormal> all;
  std::vector<Neighbor> same_place;
  for (const MeasuredNormal& m : measured) {
    if (m.pick < 0 || static_cast<std::size_t>(m.pick) >= points.size())
      throw InvalidInputError("estimating tangent planes", "There is a measured normal for pick number " + std::to_string(m.pick) + ", which does not exist.");
    const Vector3 unit = m.normal.stableNormalized();
    if (!m.normal.allFinite() || !(unit.squaredNorm() > 0.5))
      throw InvalidInputError("estimating tangent planes", "The measured normal of pick number " + std::to_string(m.pick) + " has no direction.");
    grid.within(points[static_cast<std::size_t>(m.pick)], 0.0, same_place);
    for (const Neighbor& pick : same_place)
      all.push_back({pick.index, unit});
  }
  std::stable_sort(all.begin(), all.end(), [](const MeasuredNormal& a, const MeasuredNormal& b) { return a.pick < b.pick; });
  for (std::size_t i = 0, end = 0; i < all.size(); i = end) {
    Vector3 sum = Vector3::Zero(); // of lines: all turned to the side of the first
    for (end = i; end < all.size() && all[end].pick == all[i].pick; ++end)
      sum += all[end].normal.dot(all[i].normal) < 0.0 ? Vector3(-all[end].normal) : all[end].normal;
    picks_.push_back(all[i].pick);
    normals_.push_back(sum.normalized());
  }
  if (!picks_.empty())
    flags_.assign(points.size(), false);
  for (const Index pick : picks_)
    flags_[static_cast<std::size_t>(pick)] = true;
}

const Vector3& MeasuredNormals::of(Index pick) const {
  return normals_[static_cast<std::size_t>(std::lower_bound(picks_.begin(), picks_.end(), pick) - picks_.begin())];
}

} // namespace graben::detail
