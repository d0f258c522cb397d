#pragma once

#include "graben/filters/fault_distance.h"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace graben::detail {

/// Distances to faults of the few picks near one, by pick; takes an eighth of a byte for each of the others.
class BandDistances {
public:
  BandDistances() = default;
  /// \param[in] near each pick once, in any order
  BandDistances(std::size_t picks, std::vector<PickNearFault> near)
      : words_(picks / 64 + 1) {
    const auto comes_first = [](const PickNearFault& a, const PickNearFault& b) { return a.pick < b.pick; };
    if (!std::is_sorted(near.begin(), near.end(), comes_first))
      std::sort(near.begin(), near.end(), comes_first);
    distances_.reserve(near.size());
    for (const PickNearFault& p : near) {
      const auto pick = static_cast<std::size_t>(p.pick);
      words_[pick / 64].bits |= std::uint64_t(1) << pick % 64;
      distances_.push_back(p.distance);
    }
    std::size_t before = 0;
    for (Word& word : words_) {
      word.before = before;
      before += static_cast<std::size_t>(__builtin_popcountll(word.bits));
    }
  }

  /// Infinite for picks that are not in the band.
  double operator[](std::size_t pick) const {
    const Word& word = words_[pick / 64];
    const std::uint64_t bit = std::uint64_t(1) << pick % 64;
    if ((word.bits & bit) == 0)
      return std::numeric_limits<double>::infinity();
    return distances_[word.before + static_cast<std::size_t>(__builtin_popcountll(word.bits & (bit - 1)))];
  }

private:
  struct Word {
    std::uint64_t bits = 0;
    std::size_t before = 0; ///< bits set in earlier words
  };
  std::vector<Word> words_;
  std::vector<double> distances_;
};

} // namespace graben::detail
