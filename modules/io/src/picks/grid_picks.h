#pragma once

#include "picks/pick_formats.h"

namespace graben {

/// Kinds of grids, which are read as picks on their nodes.
enum class GridKind { None, Irap, Zmap, Gxf, Cps3, SurferText, Surfer6, Surfer7, Esri };

/// What kind of grid a file is by its content.
GridKind gridKindOf(std::string_view bytes);

/// The nodes of a grid that have a value, in the file's order; those without have a z that is not a number.
PickSet readGridPicks(const PickFile& file);

} // namespace graben
