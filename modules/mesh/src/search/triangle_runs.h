#pragma once

#include "search/run_search.h"
#include "search/scaled_box.h"

#include "graben/mesh/bounds.h"
#include "graben/mesh/triangle_mesh.h"

namespace graben::detail {

/// The triangles of a mesh in runs of consecutive ones that lie near each other, and a tree of boxes over them, eight to a node.
class TriangleRuns {
public:
  TriangleRuns(const TriangleMesh& mesh, unsigned threads);

  bool empty() const { return runs_.empty(); }
  /// Valid as long as this and the mesh are.
  RunsView view(const TriangleMesh& mesh) const;
  /// Largest absolute coordinate.
  double scale() const { return scale_; }
  double perLength() const { return per_length_; }
  /// A place in the frame of the boxes.
  Vector3 scaled(const Vector3& p) const { return (p - origin_) * per_length_; }

  /// Calls visit(run) for the runs around a place, the nearest mostly first, as long as they are within reach(), which may fall on the way.
  template <typename Reach, typename Visit>
  void visitAround(const Vector3& p, const Reach& reach, const Visit& visit) const;

private:
  struct BoxedRun;
  std::vector<BoxedRun> form(const TriangleMesh& mesh, unsigned threads) const;
  void chooseUnits(const std::vector<BoxedRun>& runs);
  void arrange(std::vector<BoxedRun>& runs, unsigned threads) const;
  void stackBoxes(const std::vector<BoxedRun>& runs);

  std::vector<TriangleRun> runs_;
  std::vector<std::vector<EightBoxes>> levels_; ///< box i of a level is around the eight of node i of the one before, in the first around run i
  Vector3 origin_ = Vector3::Zero();
  double per_length_ = 1.0; ///< power of two that brings the mesh into -1 to 1 about origin_
  double scale_ = 0.0;
};

template <typename Reach, typename Visit>
void TriangleRuns::visitAround(const Vector3& p, const Reach& reach, const Visit& visit) const {
  struct Entry {
    float gap2;
    int level; ///< -1: a run
    std::size_t index;
  };
  std::array<Entry, kWidth * RunsView::kMostLevels> stack; // NOLINT: filled as far as it is read
  std::size_t size = 0;
  const ScaledBox query(scaled(p), scaled(p));
  stack[size++] = {0.0F, static_cast<int>(levels_.size()) - 1, 0};
  while (size > 0) {
    const Entry top = stack[--size];
    const float limit = squaredReach(reach(), per_length_);
    if (top.gap2 > limit)
      continue;
    if (top.level < 0) {
      visit(runs_[top.index]);
      continue;
    }
    const auto gap2 = query.squaredDistances(levels_[static_cast<std::size_t>(top.level)][top.index]);
    const std::size_t count = top.level == 0 ? runs_.size() : levels_[static_cast<std::size_t>(top.level) - 1].size();
    const std::size_t base = size;
    for (std::size_t k = 0, child = kWidth * top.index; k < kWidth && child < count; ++k, ++child)
      if (const float gap = gap2[static_cast<Eigen::Index>(k)]; gap <= limit) {
        std::size_t at = size++;
        for (; at > base && stack[at - 1].gap2 < gap; --at) // the nearest comes on top
          stack[at] = stack[at - 1];
        stack[at] = {gap, top.level - 1, child};
      }
  }
}

} // namespace graben::detail
