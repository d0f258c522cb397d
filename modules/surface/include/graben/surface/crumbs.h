#pragma once

#include "graben/surface/cut_mesh.h"

namespace graben {

/// Removes the connected components with fewer than \a least triangles, unless that leaves nothing.
/// \return how many components were removed
std::size_t removeCrumbs(CutMesh& cut, std::size_t least);

} // namespace graben
