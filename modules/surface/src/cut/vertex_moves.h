#pragma once

#include "graben/faults/fault_network.h"
#include "graben/mesh/vertex_corners.h"
#include "graben/surface/cut_mesh.h"

#include <cstdint>

namespace graben {

/// A place put back on the faults a vertex lies on; off all faults it stays. At a branch line the two projections are repeated until they agree.
Vector3 ontoFaults(const FaultNetwork& faults, const std::array<Index, 2>& on, Vector3 place);

/// Adds the vertices within a number of rings of triangles to those marked with 1 in \a in; the others have 0.
void growRings(const std::vector<Triangle>& triangles, int rings, unsigned threads, std::vector<std::uint8_t>& in);

/// Moves the vertices of a mesh with normals to new places so that none gets through a fault.
///
/// Where vertices on a fault slide along it, the vertices beside them are drawn along, so that triangles keep their shape. A vertex that would
/// still end beyond a fault stops short of it. Holds for one mesh and its triangles, through any number of moves. Deterministic for any number of
/// threads; A move takes time in proportion to the vertices near faults.
class VertexMover {
public:
  /// \param[in] corners of the mesh, used by the constructor alone
  VertexMover(const CutMesh& cut, const VertexCorners& corners, const FaultNetwork& faults, unsigned threads);

  /// The vertices within a few rings of triangles of the faults, in rising order; all others may be moved at will.
  const std::vector<Index>& belt() const { return belt_; }

  /// Where the vertices of the belt are.
  Points places(const CutMesh& cut) const;

  /// Sets where a vertex goes: one outside the belt is moved there at once. Different vertices may be sent from different threads.
  void send(Index vertex, const Vector3& to, CutMesh& cut, Points& targets) const;

  /// Moves the vertices of the belt, when all others are where they are to be. \param[in] targets places(), changed by send()
  void move(CutMesh& cut, Points targets) const;

private:
  void drag(const CutMesh& cut, Points& targets) const;
  void pullBack(const CutMesh& cut, Points& targets) const;
  bool settle(const CutMesh& cut, const Points& targets, std::size_t i, Points& seen, Vector3& place) const;
  const Vector3& placeOf(const CutMesh& cut, const Points& targets, std::size_t neighbor) const;

  const FaultNetwork& faults_;
  unsigned threads_;
  std::vector<Index> in_belt_; ///< for each vertex its number in the belt, -1 for one outside; empty if there are no faults
  std::vector<Index> belt_;
  std::vector<std::size_t> first_; ///< the neighbours of belt_[i] are neighbors_[first_[i]] to neighbors_[first_[i + 1] - 1]
  std::vector<Index> neighbors_;
  std::vector<Index> slot_; ///< of each of neighbors_ in the belt, -1 if it is not there
};

} // namespace graben
