#pragma once

#include "graben/mesh/bounds.h"
#include "graben/mesh/tetrahedron_mesh.h"

#include <functional>

namespace graben {

/// Which faces of the box a place lies on: one bit for each.
unsigned wallsOf(const Vector3& p, const Bounds& box);

/// A mesh cut where a field of its nodes is zero.
struct LevelCut {
  std::vector<double>* field = nullptr;        ///< NaN where there is nothing to cut
  std::vector<std::vector<double>*> others;    ///< further fields of the nodes, carried along
  const std::vector<std::uint8_t>* fixed = nullptr; ///< vertices that must stay where they are
  const Bounds* box = nullptr;                 ///< vertices on its faces stay on them
  std::function<bool(Index a, Index b)> along; ///< whether an edge between two nodes may be cut; empty: all
  double warp = 0.0; ///< share of an edge within which its free end is moved to the crossing instead of cutting a sliver off
  double snap = 0.0; ///< the same for an end that must stay: it counts as on the level
  std::function<bool(Index node)> may_snap;    ///< empty: all
  unsigned threads = 0;
};

/// Cuts until no edge has its ends on different sides: afterwards no tetrahedron has corners of both signs.
void cutAtZero(TetrahedronMesh& mesh, const LevelCut& cut);

/// The sign of a cell in a field that does not change within cells: of its corner farthest from zero; 0 where all are zero or not known.
int cellSign(const Tetrahedron& cell, const std::vector<double>& field);

} // namespace graben
