#include "graben/filters/stray_picks.h"

#include "graben/core/sort_unique.h"

namespace graben {

namespace {

constexpr std::size_t kSteps = 24; // nearest picks that a group grows to from each of its own

class Groups {
public:
  Groups(const NeighborGrid& grid, const FaultNetwork& faults, const StrayOptions& options)
    : grid_(grid), faults_(faults), options_(options), group_(grid.points().size(), kUnknown) {}

  void lookAt(Index pick) {
    if (group_[static_cast<std::size_t>(pick)] != kUnknown || !placeOf(pick).allFinite())
      return;
    members_.assign(1, pick);
    group_[static_cast<std::size_t>(pick)] = kOpen;
    const bool large = grow();
    for (const Index member : members_)
      group_[static_cast<std::size_t>(member)] = large ? kLarge : kSmall;
    if (!large)
      strays_.insert(strays_.end(), members_.begin(), members_.end());
  }

  std::vector<Index> strays() && {
    sortUnique(strays_);
    return std::move(strays_);
  }

private:
  enum State : char { kUnknown, kOpen, kLarge, kSmall };

  const Vector3& placeOf(Index pick) const { return grid_.points()[static_cast<std::size_t>(pick)]; }

  /// \return whether the group is large enough, or joins one that is
  bool grow() {
    for (std::size_t next = 0; next < members_.size(); ++next) {
      const Index from = members_[next];
      grid_.nearest(placeOf(from), kSteps, near_, options_.step);
      for (const Neighbor& n : near_) {
        State& state = group_[static_cast<std::size_t>(n.index)];
        if (state == kOpen || faults_.crosses(placeOf(from), placeOf(n.index)))
          continue;
        if (state == kLarge)
          return true;
        state = kOpen;
        members_.push_back(n.index);
        if (members_.size() >= options_.fewest)
          return true;
      }
    }
    return false;
  }

  const NeighborGrid& grid_;
  const FaultNetwork& faults_;
  const StrayOptions& options_;
  std::vector<State> group_;
  std::vector<Index> members_;
  std::vector<Neighbor> near_;
  std::vector<Index> strays_;
};

} // namespace

std::vector<Index> strayPicks(const NeighborGrid& grid, const FaultNetwork& faults, const std::vector<Index>& among, const StrayOptions& options) {
  Groups groups(grid, faults, options);
  for (const Index pick : among)
    groups.lookAt(pick);
  return std::move(groups).strays();
}

} // namespace graben
