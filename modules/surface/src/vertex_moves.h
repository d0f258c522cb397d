#pragma once

#include "graben/faults/fault_network.h"
#include "graben/surface/cut_mesh.h"

#include <cstdint>

namespace graben {

/// A place put back on the faults a vertex lies on; off all faults it stays. At a branch line the two projections are repeated until they agree.
Vector3 ontoFaults(const FaultNetwork& faults, const std::array<Index, 2>& on, Vector3 place);

/// Adds the vertices within a number of rings of triangles to those marked in \a in.
void growRings(const std::vector<Triangle>& triangles, int rings, std::vector<std::uint8_t>& in);

/// Moves the vertices of a mesh with normals to new places so that none gets through a fault.
///
/// Where vertices on a fault slide along it, the vertices beside them are drawn along, so that triangles keep their shape. A vertex that would
/// still end beyond a fault stops short of it.
/// \param[in] targets one place per vertex, at the same place for those that do not move
/// Deterministic for any number of threads; O(vertices).
void moveVertices(CutMesh& cut, const FaultNetwork& faults, Points targets, unsigned threads);

} // namespace graben
