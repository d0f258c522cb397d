#pragma once

#include "graben/core/export.h"
#include "graben/core/progress.h"
#include "graben/mesh/triangle_mesh.h"
#include "graben/surface/lattice.h"
#include "graben/surface/signed_distance.h"

GRABEN_EXPORT_BEGIN
namespace graben {

struct ExtractionOptions {
  Lattice lattice;                ///< voxel size and where the lattice stands
  double iso_level = 0.0;         ///< signed distance of the surface from the data, in the picks' units
  double flip_angle = 60.0;       ///< degrees, 0 to 180; the paper's flip angle f, 180 switches the test off
  double snap = 0.0;              ///< fraction of an edge, 0 to 0.4: vertices within it of a lattice vertex are joined there, which takes marching cubes'
                                  ///< slivers away; 0: every vertex stays on its own lattice edge
  unsigned threads = 0;           ///< 0: one per processor
  std::size_t memory_limit = 0;   ///< bytes the extraction may take; 0: no limit
  ProgressCallback progress;
};

/// Refuses a voxel size that the extraction could not do with, from the places of the picks alone: before anything is computed or allocated.
/// \param[in] reach how far the surface goes from the picks (SignedDistanceOptions::rho_plus_delta)
/// \param[in] memory_limit bytes the extraction may take; 0: no limit
/// \throw ResourceError if the lattice would be too large for its index range or the memory limit; the message names a voxel size that fits.
///        Cells are estimated from the places that hold picks, at the low end: a job that fits is not refused, and one that does not may be refused later
/// O(picks), and less where it is plain that the job fits.
void checkVoxelSize(const NeighborGrid& grid, const Lattice& lattice, double reach, std::size_t memory_limit, unsigned threads = 0);

/// The surface as sheets: in a cell that a fault crosses each side has a sheet of its own, carried on through the fault to the end of the cell.
struct SheetMesh {
  TriangleMesh mesh;
  /// For each triangle the entry in homes it must be trimmed to, -1 where no fault crosses its cell.
  std::vector<Index> home;
  /// The lattice vertices a sheet of a faulted cell belongs to: what a fault hides from all of them lies beyond the fault.
  std::vector<Points> homes;
  std::size_t rejected_by_flip_angle = 0; ///< triangles not extracted because of the flip angle
  std::size_t cells = 0;                  ///< cells with a piece of the surface
};

/// Marching cubes on a narrow band that follows the surface from the cells the picks lie in.
///
/// A cell is extracted where the field is defined at all its corners (Hoppe 1992). The paper's section 3: a corner is semi-undefined when the plane
/// found for it does not meet the cell; in a cell with such a corner a triangle is left out if its normal makes more than the flip angle with the
/// mean normal of the other corners' planes (the paper's printed inequality has its sign the wrong way round).
/// Beyond the paper: where faults cross a cell, its corners fall into groups that no crossed edge joins. Each group gets a copy of the cell, in which the
/// corners of the other groups take values carried on from its own picks. Around a tip line the copies join.
///
/// Away from faults the mesh is edge-manifold, indexed (a vertex per lattice edge) and oriented along the planes' normals. The same bytes for any number
/// of threads. Time and memory grow with the number of cells the surface passes through.
/// \throw ResourceError if the lattice would be too large for its index range or the memory limit; the message names a voxel size that fits
SheetMesh extractSheets(const SignedDistance& field, const ExtractionOptions& options);

} // namespace graben
GRABEN_EXPORT_END
