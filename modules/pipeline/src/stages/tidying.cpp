#include "stages/tidying.h"

#include "measures/against_picks.h"

#include "graben/analysis/bridges.h"
#include "graben/analysis/flipped_triangles.h"
#include "graben/core/sort_unique.h"
#include "graben/mesh/normals.h"
#include "graben/surface/crumbs.h"
#include "graben/surface/folds.h"

namespace graben {

namespace {

constexpr int kRounds = 4;
constexpr int kBeforeSliding = 2; // rounds

/// The triangles that may be out of order, on which all that is done to the mesh keeps an eye.
class Suspects {
public:
  Suspects(CutMesh& cut, const VertexCorners& corners, const TidyingInput& input, unsigned threads)
    : cut_(cut), corners_(corners), input_(input), threads_(threads), triangles_(standingOut(cut.mesh, threads)) {}

  std::vector<Index> turned() const { return turnedTriangles(cut_.mesh, corners_, triangles_); }
  std::vector<Index> folded() const { return foldedTriangles(cut_.mesh, corners_, triangles_); }
  /// Only faults make any; on a thin part of an object the nearest pick may well be one of its far side.
  std::vector<Index> againstPicks() const {
    if (input_.faults.empty())
      return {};
    return trianglesAgainstPicks(cut_.mesh, triangles_, input_.grid, input_.pick_normals, input_.pick_reach);
  }

  /// \param[in] slide whether vertices on faults move too, along them
  void relax(const std::vector<Index>& triangles, bool slide) {
    if (slide)
      relaxAlongFaults(cut_, corners_, triangles, input_.faults);
    relaxTriangles(cut_, corners_, triangles);
    relaxed_.insert(relaxed_.end(), triangles.begin(), triangles.end());
    const std::vector<Index> moved = around(triangles);
    triangles_.insert(triangles_.end(), moved.begin(), moved.end());
    sortUnique(triangles_);
  }

  /// Brings normals up to date; from now on those alone are suspect that what was relaxed may have changed. \return whether anything was
  bool renew() {
    const std::vector<Index> moved = around(relaxed_);
    std::vector<Index> vertices;
    for (const Index t : moved)
      vertices.insert(vertices.end(), triangle(t).begin(), triangle(t).end());
    sortUnique(vertices);
    updateVertexNormals(cut_.mesh, corners_, vertices, threads_);
    triangles_ = around(moved);
    relaxed_.clear();
    return !moved.empty();
  }

private:
  const Triangle& triangle(Index t) const { return cut_.mesh.triangles[static_cast<std::size_t>(t)]; }

  /// All triangles that share a corner with those named, those included, in rising order.
  std::vector<Index> around(const std::vector<Index>& triangles) const {
    std::vector<Index> found;
    for (const Index t : triangles)
      for (const Index v : triangle(t))
        for (const Index corner : corners_.of(static_cast<std::size_t>(v)))
          found.push_back(corner / 3);
    sortUnique(found);
    return found;
  }

  CutMesh& cut_;
  const VertexCorners& corners_;
  const TidyingInput& input_;
  unsigned threads_;
  std::vector<Index> triangles_; ///< in rising order
  std::vector<Index> relaxed_;
};

/// Relaxes what is out of order, for a few rounds. \return whether nothing was left to relax
bool unfold(Suspects& suspects) {
  for (int round = 0; round < kRounds; ++round) {
    const bool slide = round >= kBeforeSliding;
    suspects.relax(suspects.turned(), slide);
    suspects.relax(suspects.folded(), slide);
    suspects.relax(suspects.againstPicks(), slide);
    if (!suspects.renew())
      return true;
  }
  return false;
}

} // namespace

TidyingResult tidy(CutMesh& cut, VertexCorners& corners, const TidyingInput& input, unsigned threads) {
  computeVertexNormals(cut.mesh, corners, threads);
  Suspects suspects(cut, corners, input, threads);
  TriangleRemoval removal(cut, corners);
  TidyingResult result;
  if (!unfold(suspects)) {
    result.folds = removal.take(suspects.turned());
    result.folds += removal.take(suspects.folded());
    result.folds += removal.take(suspects.againstPicks());
  }
  if (!input.faults.empty())
    result.bridges = removal.take(bridgingTriangles(cut.mesh, corners, input.faults, input.on_fault, threads));
  if (removal.empty())
    return result;
  const TriangleRemoval::Result removed = removal.finish(input.crumb, threads);
  result.crumbs = removed.crumbs;
  corners = VertexCorners(cut.mesh, threads);
  updateVertexNormals(cut.mesh, corners, removed.touched, threads);
  return result;
}

} // namespace graben
