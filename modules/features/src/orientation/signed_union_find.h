#pragma once

#include "graben/core/types.h"

#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace graben::detail {

/// Disjoint sets whose members carry a sign relative to their set's representative.
class SignedUnionFind {
public:
  explicit SignedUnionFind(std::size_t count)
      : parent_(count)
      , flipped_(count, 0)
      , size_(count, 1) {
    std::iota(parent_.begin(), parent_.end(), Index(0));
  }

  /// Representative of i's set, and whether i is flipped against it.
  std::pair<Index, bool> find(Index i) {
    Index root = i;
    bool flipped = false;
    while (parent_[at(root)] != root) {
      flipped ^= flipped_[at(root)] != 0;
      root = parent_[at(root)];
    }
    bool rest = flipped;
    while (parent_[at(i)] != root && i != root) { // hang the whole path on the root
      const Index next = parent_[at(i)];
      const bool own = flipped_[at(i)] != 0;
      parent_[at(i)] = root;
      flipped_[at(i)] = rest ? 1 : 0;
      rest ^= own;
      i = next;
    }
    return {root, flipped};
  }

  /// Joins the sets of a and b so that one is flipped against the other, or not; nothing if they
  /// are in one set already. Returns false if they are in one set otherwise.
  bool join(Index a, Index b, bool against) {
    auto [root_a, flip_a] = find(a);
    auto [root_b, flip_b] = find(b);
    if (root_a == root_b)
      return (flip_a != flip_b) == against;
    if (size_[at(root_a)] < size_[at(root_b)])
      std::swap(root_a, root_b);
    parent_[at(root_b)] = root_a;
    flipped_[at(root_b)] = flip_a != flip_b ? !against : against;
    size_[at(root_a)] += size_[at(root_b)];
    return true;
  }

  /// Makes i a set of its own again; all others of its set must be reset as well.
  void reset(Index i) {
    parent_[at(i)] = i;
    flipped_[at(i)] = 0;
    size_[at(i)] = 1;
  }

private:
  static std::size_t at(Index i) { return static_cast<std::size_t>(i); }

  std::vector<Index> parent_;
  std::vector<std::uint8_t> flipped_; ///< against the parent
  std::vector<std::uint32_t> size_;
};

} // namespace graben::detail
