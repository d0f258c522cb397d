#pragma once

#include "graben/core/export.h"
#include "graben/faults/fault_surface.h"
#include "graben/mesh/triangle_mesh.h"
#include "graben/synthetic/synthetic_options.h"

#include <memory>

GRABEN_EXPORT_BEGIN
namespace graben {

/// A pick and where it came from.
struct SyntheticPick {
  Vector3 position = Vector3::Zero(); ///< as delivered: with noise and smear
  Vector3 truth = Vector3::Zero();    ///< the point of the true horizon it was taken from
  Index sheet = 0;                    ///< sheet of that point
  Index block = 0;                    ///< block of that point
  Index line = -1;                    ///< the line, grid row or contour it lies on; -1: scattered
};

/// All picks; entry i of each array is pick i.
struct SyntheticPicks {
  Points points;
  std::vector<Index> block;
  std::vector<Index> line; ///< of the lines, grid rows or contours; empty where picks are scattered
};

/// One true cutoff line: where a sheet meets a fault, in order along strike.
struct TrueCutoffLine {
  Index fault = 0;
  int side = 0; ///< -1: cutoff of the footwall, +1: of the hanging wall
  Index block = 0;
  /// On the fault and on the sheet to 1e-6 m (at the tip, where the sheet is infinitely steep, to
  /// what rounding x, y allows). The ends are at the area's edge, the tip or another cutoff line.
  Points points;
};

/// A faulted horizon known exactly. All points, normals and meshes are in the user's frame of the
/// options.
///
/// Immutable; all methods are const, thread-safe and deterministic (same bytes for any number of
/// threads).
class SyntheticModel {
public:
  /// \throw InvalidInputError if an option is out of range, or faults that must not meet do
  explicit SyntheticModel(const SyntheticOptions& options);
  ~SyntheticModel();
  SyntheticModel(SyntheticModel&&) noexcept;
  SyntheticModel& operator=(SyntheticModel&&) noexcept;

  const SyntheticOptions& options() const;
  std::size_t faultCount() const;
  std::size_t sheetCount() const;
  std::size_t blockCount() const;
  Index blockOfSheet(Index sheet) const;

  /// Pick \a i of the endless sequence of the seed.
  /// \throw InvalidInputError if holes, gaps and shadows leave no room for picks, or the sampling is not scattered
  SyntheticPick pick(std::uint64_t i) const;

  /// The picks of the sampling, of scattered ones the first options().picks, in parallel; O(n). A pick's noise depends on the seed and the number
  /// of its place alone. \param[in] threads 0: one per processor \throw InvalidInputError if there is no room for picks
  SyntheticPicks picks(unsigned threads = 0) const;

  /// Fault \a i as given to an interpreter (with overhang, shift and branch gap): a grid of
  /// triangles, normals towards the hanging wall. Its vertices lie on the fault; O(vertices).
  TriangleMesh faultMesh(std::size_t i) const;

  /// The same as sticks, each from top to bottom, in order along strike.
  std::vector<FaultStick> faultSticks(std::size_t i) const;

  /// The true horizon of each block, cut exactly: border vertices at a fault lie on the fault and
  /// on the sheet to 1e-6 m; normals are exact and `piece` is the block. \param[in] resolution edge
  /// length; 0: the picks' spacing, but at least a 500th of the size
  std::vector<TriangleMesh> truthMeshes(double resolution = 0.0) const;

  /// The true cutoff lines. \param[in] resolution point distance along strike; 0: as for
  /// truthMeshes
  std::vector<TrueCutoffLine> cutoffLines(double resolution = 0.0) const;

  /// z of a block's true horizon at x, y; past the block's border its smooth continuation. Where a
  /// block lies over itself (reverse fault with a tip) the sheet that reaches farther past x, y.
  double truthHeight(Index block, double x, double y) const;

  /// Unit normal of the same, upwards in space.
  Vector3 truthNormal(Index block, double x, double y) const;

  /// z and normal of one sheet, continued past its borders.
  double sheetHeight(Index sheet, double x, double y) const;
  Vector3 sheetNormal(Index sheet, double x, double y) const;

  /// True if the sheet covers x, y inside the area: not past one of its cutoffs.
  bool sheetCovers(Index sheet, double x, double y) const;

  /// The block whose side of all faults a point in space is on, by the unlimited (not the given)
  /// fault surfaces.
  Index blockOf(const Vector3& p) const;

  /// Distance to the tangent plane of the block's horizon over x, y of \a p, in local units: exact
  /// to second order.
  double distanceToTruth(Index block, const Vector3& p) const;

  /// Horizontal distance along the fault's dip direction from the true fault (unlimited by its tip)
  /// to \a p, in local units; positive in the hanging wall.
  double faultOffset(std::size_t fault, const Vector3& p) const;

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

} // namespace graben
GRABEN_EXPORT_END
