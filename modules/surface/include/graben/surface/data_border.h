#pragma once

#include "graben/core/export.h"
#include "graben/surface/sheet_extraction.h"

GRABEN_EXPORT_BEGIN
namespace graben {

struct DataBorderOptions {
  double overhang = 0.0; ///< how far the surface reaches beyond the outermost picks, in the picks' units; more than 0
  unsigned threads = 0;  ///< 0: one per processor
  double iso_level = 0.0; ///< signed distance of the surface from the data, in the picks' units
};

/// Trims the ragged steps in which whole cells end at the edge of the data: the surface ends at the given distance from the outermost picks.
///
/// Every place with picks all round, or enclosed by picks and faults (see SignedDistanceOptions::fault_reach), stays.
/// Triangles are split where the distance passes the limit. Only triangles within a few rings of the mesh's border are looked
/// at; O(triangles) to find them. Vertices that no triangle uses any more are left in the mesh: cutSheets() drops them.
/// Deterministic for any number of threads.
void trimToData(SheetMesh& sheets, const SignedDistance& field, const DataBorderOptions& options);

} // namespace graben
GRABEN_EXPORT_END
