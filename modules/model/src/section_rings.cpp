#include "section_rings.h"

#include <algorithm>

namespace graben {

void RingBuilder::add(const Name& from, const SectionPoint2& a, const Name& to, const SectionPoint2& b) {
  if (from == to)
    return;
  next_.emplace(from, to);
  place_.emplace(from, a);
  place_.emplace(to, b);
}

void RingBuilder::close(std::vector<Name> ends, std::vector<Name> starts) {
  const auto lower = [this](const Name& a, const Name& b) {
    const double za = place_.at(a).y(), zb = place_.at(b).y();
    return za != zb ? za < zb : a < b;
  };
  std::sort(ends.begin(), ends.end(), lower);
  std::sort(starts.begin(), starts.end(), lower);
  for (std::size_t i = 0; i < std::min(ends.size(), starts.size()); ++i)
    next_.emplace(ends[i], starts[i]);
}

std::vector<std::vector<SectionPoint2>> RingBuilder::rings() const {
  std::multimap<Name, Name> left = next_;
  std::vector<std::vector<SectionPoint2>> result;
  while (!left.empty()) {
    std::vector<SectionPoint2> ring;
    const Name first = left.begin()->first;
    for (Name at = first;;) {
      const auto step = left.find(at);
      if (step == left.end())
        break;
      const SectionPoint2& p = place_.at(at);
      if (ring.empty() || ring.back() != p)
        ring.push_back(p);
      at = step->second;
      left.erase(step);
      if (at == first && left.find(first) == left.end())
        break;
    }
    if (ring.size() > 1 && ring.front() == ring.back())
      ring.pop_back();
    if (ring.size() > 2)
      result.push_back(std::move(ring));
  }
  return result;
}

double ringArea(const std::vector<SectionPoint2>& ring) {
  double twice = 0.0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const SectionPoint2 a = ring[i] - ring.front();
    const SectionPoint2 b = ring[(i + 1) % ring.size()] - ring.front();
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * twice;
}

} // namespace graben
