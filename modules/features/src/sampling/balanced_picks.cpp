#include "graben/features/balanced_picks.h"

#include "graben/core/threads.h"

#include <algorithm>
#include <limits>

namespace graben {

namespace {

constexpr double kApart = 0.2;      // line distances: between two points at least; on the mean they are then a quarter apart
constexpr std::size_t kFewest = 8;  // of the nearest points looked at, until one is found that no fault hides
constexpr std::size_t kMost = 512;
constexpr std::size_t kGrain = 256;

bool hidden(const FaultNetwork& faults, const Vector3& a, const Vector3& b) {
  if (faults.empty())
    return false;
  Bounds box;
  box.extend(a);
  box.extend(b);
  return faults.mayTouch(box) && faults.crosses(a, b);
}

class Balancing {
public:
  Balancing(const NeighborGrid& grid, const PickLayout& layout, const FaultNetwork& faults, unsigned threads)
    : grid_(grid), picks_(grid.points()), layout_(layout), faults_(faults), threads_(threads) {}

  BalancedPicks run() {
    chooseSeeds();
    assign();
    return means();
  }

private:
  double apart(Index pick) const { return kApart * static_cast<double>(layout_.line_distances[static_cast<std::size_t>(pick)]); }
  const Vector3& place(Index pick) const { return picks_[static_cast<std::size_t>(pick)]; }

  /// One after the other each pick that no seed so far stands for becomes one.
  void chooseSeeds() {
    std::vector<char> covered(picks_.size(), 0);
    PointsAround around;
    for (const Index pick : grid_.order()) {
      if (covered[static_cast<std::size_t>(pick)] != 0)
        continue;
      seeds_.push_back(pick);
      if (!(apart(pick) > 0.0))
        continue;
      grid_.collectWithin(place(pick), apart(pick), around);
      for (std::size_t i = 0; i < around.count; ++i) {
        const Index other = around.index[i];
        if (covered[static_cast<std::size_t>(other)] == 0 && apart(other) > 0.0 && !hidden(faults_, place(pick), place(other)))
          covered[static_cast<std::size_t>(other)] = 1;
      }
    }
  }

  /// Each pick on a line goes to the nearest seed in sight.
  void assign() {
    seed_of_.assign(picks_.size(), -1);
    Points places(picks_.size(), Vector3::Constant(std::numeric_limits<double>::quiet_NaN()));
    for (std::size_t s = 0; s < seeds_.size(); ++s) {
      seed_of_[static_cast<std::size_t>(seeds_[s])] = static_cast<Index>(s);
      if (apart(seeds_[s]) > 0.0)
        places[static_cast<std::size_t>(seeds_[s])] = place(seeds_[s]);
    }
    const NeighborGrid seeds(places, 0.0, threads_);
    const std::vector<Index> seed_of = seed_of_;
    parallelBlocks(grid_.order().size(), kGrain, threads_, [&](std::size_t begin, std::size_t end) {
      std::vector<Neighbor> near;
      for (std::size_t i = begin; i < end; ++i) {
        const Index pick = grid_.order()[i];
        if (seed_of[static_cast<std::size_t>(pick)] < 0)
          seed_of_[static_cast<std::size_t>(pick)] = seed_of[static_cast<std::size_t>(nearestSeed(seeds, pick, near))];
      }
    });
  }

  Index nearestSeed(const NeighborGrid& seeds, Index pick, std::vector<Neighbor>& near) const {
    for (std::size_t count = kFewest; count <= kMost; count *= 4) {
      seeds.nearest(place(pick), count, near);
      for (const Neighbor& seed : near)
        if (!hidden(faults_, place(seed.index), place(pick)))
          return seed.index;
      if (near.size() < count)
        break;
    }
    return near.front().index;
  }

  BalancedPicks means() const {
    BalancedPicks result;
    result.of = seed_of_;
    result.points.assign(seeds_.size(), Vector3::Zero());
    result.picks.assign(seeds_.size(), 0);
    for (std::size_t i = 0; i < picks_.size(); ++i) {
      if (seed_of_[i] < 0)
        continue;
      result.points[static_cast<std::size_t>(seed_of_[i])] += picks_[i];
      ++result.picks[static_cast<std::size_t>(seed_of_[i])];
    }
    for (std::size_t s = 0; s < seeds_.size(); ++s) {
      Vector3& mean = result.points[s];
      mean /= static_cast<double>(result.picks[s]);
      if (result.picks[s] == 1 || hidden(faults_, place(seeds_[s]), mean))
        mean = place(seeds_[s]);
    }
    return result;
  }

  const NeighborGrid& grid_;
  const Points& picks_;
  const PickLayout& layout_;
  const FaultNetwork& faults_;
  unsigned threads_;
  std::vector<Index> seeds_;   ///< picks
  std::vector<Index> seed_of_; ///< for each pick its place in seeds_
};

} // namespace

BalancedPicks balancedPicks(const NeighborGrid& grid, const PickLayout& layout, const FaultNetwork& faults, unsigned threads) {
  return Balancing(grid, layout, faults, threads).run();
}

} // namespace graben
