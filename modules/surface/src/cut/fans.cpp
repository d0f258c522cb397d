#include "fans.h"

#include <algorithm>

namespace graben {

std::size_t Fans::find(Index vertex, VertexCorners::Range corners) {
  if ((cuts_ == nullptr || !cut_.onFault(vertex)) && isRing(vertex, corners))
    return 1;
  list(vertex, corners);
  join(vertex);
  return number();
}

/// The vertices beside a corner in its triangle, the next one first.
std::array<Index, 2> Fans::beside(Index corner) const {
  const Triangle& t = cut_.mesh.triangles[static_cast<std::size_t>(corner / 3)];
  const auto e = static_cast<std::size_t>(corner % 3);
  return {t[e == 2 ? 0 : e + 1], t[e == 0 ? 2 : e - 1]};
}

/// True if the triangles, not too many, follow each other once round; every edge then has just two of them.
bool Fans::isRing(Index vertex, VertexCorners::Range corners) const {
  constexpr std::size_t most = 16;
  std::array<Index, most> after, before; // NOLINT: filled as far as they are read
  std::size_t count = 0;
  for (const Index c : corners) {
    if (count == most)
      return false;
    const auto [a, b] = beside(c);
    if (a == b || a == vertex || b == vertex)
      return false;
    after[count] = a;
    before[count++] = b;
  }
  std::size_t at = 0;
  for (std::size_t reached = 1; reached <= count; ++reached) {
    at = static_cast<std::size_t>(std::find(before.data(), before.data() + count, after[at]) - before.data());
    if (at == 0 || at == count)
      return at == 0 && reached == count;
  }
  return count == 0;
}

void Fans::list(Index vertex, VertexCorners::Range corners) {
  spokes_.clear();
  for (const Index c : corners) {
    const auto [after, before] = beside(c);
    spokes_.push_back({c, after, before, after != before && after != vertex && before != vertex});
  }
}

void Fans::join(Index vertex) {
  for (std::size_t i = 0; i < spokes_.size(); ++i) {
    const Index end = spokes_[i].after;
    std::size_t beyond = kNone;
    std::size_t meeting = 0;
    for (std::size_t j = 0; j < spokes_.size(); ++j) {
      if (!spokes_[j].proper)
        continue;
      meeting += (spokes_[j].after == end ? 1U : 0U) + (spokes_[j].before == end ? 1U : 0U);
      if (spokes_[j].before == end)
        beyond = j;
    }
    if (spokes_[i].proper && meeting == 2 && beyond != kNone && (cuts_ == nullptr || !cuts_->isCut(vertex, end))) {
      spokes_[i].next = beyond;
      spokes_[beyond].previous = i;
    }
  }
}

std::size_t Fans::number() {
  std::size_t fans = 0;
  for (std::size_t i = 0; i < spokes_.size(); ++i) {
    if (spokes_[i].fan != kNone)
      continue;
    for (std::size_t j = i; j != kNone && spokes_[j].fan == kNone; j = spokes_[j].next)
      spokes_[j].fan = fans;
    for (std::size_t j = spokes_[i].previous; j != kNone && spokes_[j].fan == kNone; j = spokes_[j].previous)
      spokes_[j].fan = fans;
    ++fans;
  }
  return fans;
}

} // namespace graben
