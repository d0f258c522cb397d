#include "cut_state.h"

#include "graben/core/threads.h"

#include <algorithm>

namespace graben {

namespace {

/// Corners (3 t + e) of triangles grouped by vertex: those of v are corners[first[v]] to corners[first[v + 1] - 1].
struct VertexCorners {
  std::vector<Index> first;
  std::vector<Index> corners;

  explicit VertexCorners(const TriangleMesh& mesh) : first(mesh.vertices.size() + 1, 0), corners(3 * mesh.triangles.size()) {
    for (const Triangle& t : mesh.triangles)
      for (const Index v : t)
        ++first[static_cast<std::size_t>(v) + 1];
    for (std::size_t v = 1; v < first.size(); ++v)
      first[v] += first[v - 1];
    std::vector<Index> cursor(first.begin(), first.end() - 1);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      for (std::size_t e = 0; e < 3; ++e)
        corners[static_cast<std::size_t>(cursor[static_cast<std::size_t>(mesh.triangles[t][e])]++)] = static_cast<Index>(3 * t + e);
  }
};

/// A vertex whose triangles fall apart, and the fan that each of its corners belongs to.
struct SplitVertex {
  Index vertex;
  std::vector<int> fan;
};

/// The fans of triangles round one vertex, joined by edges that are not cut.
class Fans {
public:
  explicit Fans(const CutState& state) : state_(state) {}

  /// \return how many there are
  int find(Index v, const Index* corners, std::size_t count) {
    next_.resize(count);
    before_.resize(count);
    fan_.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      const Triangle& t = state_.out.mesh.triangles[static_cast<std::size_t>(corners[i] / 3)];
      next_[i] = t[static_cast<std::size_t>((corners[i] % 3 + 1) % 3)];
      before_[i] = t[static_cast<std::size_t>((corners[i] % 3 + 2) % 3)];
      fan_[i] = static_cast<int>(i);
    }
    for (std::size_t i = 0; i < count; ++i)
      joinAcross(v, i);
    int fans = 0;
    for (std::size_t i = 0; i < count; ++i)
      fan_[i] = fan_[i] == static_cast<int>(i) ? fans++ : fan_[static_cast<std::size_t>(fan_[i])];
    return fans;
  }
  const std::vector<int>& fan() const { return fan_; }

private:
  /// Joins corner i with the one across its edge, if just two triangles have that edge, in opposite directions.
  void joinAcross(Index v, std::size_t i) {
    const Index to = next_[i];
    if (std::count(next_.begin(), next_.end(), to) != 1 || std::count(before_.begin(), before_.end(), to) != 1)
      return;
    if (state_.out.onFault(v) && state_.out.onFault(to) && state_.isCut(v, to))
      return;
    const auto across = static_cast<std::size_t>(std::find(before_.begin(), before_.end(), to) - before_.begin());
    const int a = std::min(fan_[i], fan_[across]);
    const int b = std::max(fan_[i], fan_[across]);
    std::replace(fan_.begin(), fan_.end(), b, a);
  }

  const CutState& state_;
  std::vector<Index> next_;   ///< the corner after this one in each triangle
  std::vector<Index> before_; ///< and the one before it
  std::vector<int> fan_;      ///< first corner of the fan that each corner is in
};

void copyVertex(CutMesh& cut, Index from) {
  const auto v = static_cast<std::size_t>(from);
  TriangleMesh& mesh = cut.mesh;
  mesh.vertices.push_back(Vector3(mesh.vertices[v]));
  if (!mesh.normals.empty())
    mesh.normals.push_back(Vector3(mesh.normals[v]));
  if (!mesh.piece.empty())
    mesh.piece.push_back(Index(mesh.piece[v]));
  for (auto& field : mesh.scalars)
    field.second.push_back(float(field.second[v]));
  cut.vertex_faults.push_back(std::array<Index, 2>(cut.vertex_faults[v]));
}

} // namespace

void openCuts(CutState& state, unsigned threads) {
  constexpr std::size_t grain = 4096;
  TriangleMesh& mesh = state.out.mesh;
  const VertexCorners around(mesh);
  std::vector<std::vector<SplitVertex>> found((mesh.vertices.size() + grain - 1) / grain);
  parallelBlocks(mesh.vertices.size(), grain, threads, [&](std::size_t begin, std::size_t end) {
    Fans fans(state);
    for (std::size_t v = begin; v < end; ++v) {
      const auto first = static_cast<std::size_t>(around.first[v]);
      const std::size_t count = static_cast<std::size_t>(around.first[v + 1]) - first;
      if (count > 1 && fans.find(static_cast<Index>(v), around.corners.data() + first, count) > 1)
        found[begin / grain].push_back({static_cast<Index>(v), fans.fan()});
    }
  });
  for (const auto& block : found)
    for (const SplitVertex& split : block) {
      const auto first_new = static_cast<Index>(mesh.vertices.size());
      const int fans = *std::max_element(split.fan.begin(), split.fan.end()) + 1;
      for (int fan = 1; fan < fans; ++fan)
        copyVertex(state.out, split.vertex);
      for (std::size_t i = 0; i < split.fan.size(); ++i) {
        const Index corner = around.corners[static_cast<std::size_t>(around.first[static_cast<std::size_t>(split.vertex)]) + i];
        if (split.fan[i] > 0)
          mesh.triangles[static_cast<std::size_t>(corner / 3)][static_cast<std::size_t>(corner % 3)] = first_new + split.fan[i] - 1;
      }
    }
}

} // namespace graben
