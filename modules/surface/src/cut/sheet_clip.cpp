#include "sheet_clip.h"

#include <algorithm>
#include <unordered_map>

namespace graben::detail {

namespace {

constexpr double kLeast = 0.35; // of an edge: crossings nearer to the kept end would make slivers

/// Leaves out the entries at the given places, which are in rising order.
template <typename T>
void erase(std::vector<T>& values, const std::vector<std::size_t>& places) {
  if (places.empty())
    return;
  const auto at = [&values](std::size_t i) { return values.begin() + static_cast<std::ptrdiff_t>(i); };
  auto kept = at(places.front());
  for (std::size_t i = 0; i < places.size(); ++i)
    kept = std::move(at(places[i] + 1), i + 1 < places.size() ? at(places[i + 1]) : values.end(), kept);
  values.erase(kept, values.end());
}

class SheetClip {
public:
  SheetClip(TriangleMesh& mesh, const ClipLimit& limit) : mesh_(mesh), limit_(limit) {}

  bool keeps(Index v) const { return limit_.beyond(v) <= limit_.limit; }

  void keepPart(const Triangle& t, std::vector<Triangle>& out) {
    const int kept = keeps(t[0]) + keeps(t[1]) + keeps(t[2]);
    if (kept == 0)
      return;
    std::size_t odd = 0; // the corner that differs from the other two
    while (keeps(t[odd]) != (kept == 1))
      ++odd;
    const Index a = t[odd];
    const Index b = t[(odd + 1) % 3];
    const Index c = t[(odd + 2) % 3];
    if (kept == 1) {
      out.push_back({a, crossing(a, b), crossing(a, c)});
      return;
    }
    const Index ab = crossing(b, a);
    const Index ac = crossing(c, a);
    out.push_back({b, c, ac});
    out.push_back({b, ac, ab});
  }

private:
  Index crossing(Index in, Index out) {
    const std::uint64_t key = (static_cast<std::uint64_t>(in) << 32) | static_cast<std::uint64_t>(out);
    const auto [entry, added] = crossings_.try_emplace(key, static_cast<Index>(mesh_.vertices.size()));
    if (added) {
      const double a = limit_.beyond(in);
      const double b = limit_.beyond(out);
      const double t = std::clamp((limit_.limit - a) / (b - a), kLeast, 1.0);
      const Vector3 p = mesh_.vertices[static_cast<std::size_t>(in)];
      mesh_.vertices.push_back(p + t * (mesh_.vertices[static_cast<std::size_t>(out)] - p));
    }
    return entry->second;
  }

  TriangleMesh& mesh_;
  const ClipLimit& limit_;
  std::unordered_map<std::uint64_t, Index> crossings_;
};

} // namespace

void clipSheets(SheetMesh& sheets, const std::vector<std::size_t>& triangles, const ClipLimit& limit) {
  SheetClip clip(sheets.mesh, limit);
  std::vector<Triangle> pieces;
  std::vector<Index> homes;
  std::vector<std::size_t> dropped;
  for (const std::size_t t : triangles) {
    const Triangle triangle = sheets.mesh.triangles[t];
    if (clip.keeps(triangle[0]) && clip.keeps(triangle[1]) && clip.keeps(triangle[2]))
      continue;
    dropped.push_back(t);
    clip.keepPart(triangle, pieces);
    homes.resize(pieces.size(), sheets.home[t]);
  }
  erase(sheets.mesh.triangles, dropped);
  erase(sheets.home, dropped);
  sheets.mesh.triangles.insert(sheets.mesh.triangles.end(), pieces.begin(), pieces.end());
  sheets.home.insert(sheets.home.end(), homes.begin(), homes.end());
}

} // namespace graben::detail
