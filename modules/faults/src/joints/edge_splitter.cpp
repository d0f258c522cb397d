#include "joints/edge_splitter.h"

#include <algorithm>

namespace graben::detail {

void EdgeSplitter::split(Index triangle, Index a, Index b, const std::vector<Index>& points) {
  std::vector<Index>& family = families_.insert({triangle, {triangle}}).first->second;
  for (const Index member : std::vector<Index>(family)) {
    Triangle t = mesh_.triangles[static_cast<std::size_t>(member)];
    for (int turn = 0; turn < 3 && !(t[0] == a && t[1] == b); ++turn)
      std::rotate(t.begin(), t.begin() + 1, t.end());
    if (t[0] != a || t[1] != b)
      continue;
    Index from = a;
    for (const Index p : points) {
      family.push_back(static_cast<Index>(mesh_.triangles.size()));
      mesh_.triangles.push_back({from, p, t[2]});
      from = p;
    }
    mesh_.triangles[static_cast<std::size_t>(member)] = {from, b, t[2]};
    return;
  }
}

} // namespace graben::detail
