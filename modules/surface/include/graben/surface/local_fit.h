#pragma once

#include "graben/core/export.h"
#include "graben/features/tangent_planes.h"
#include "graben/mesh/vertex_corners.h"
#include "graben/surface/cut_mesh.h"

#include <array>
#include <cmath>
#include <memory>

GRABEN_EXPORT_BEGIN
namespace graben {

class FaultBorders;

namespace detail {
class NormalEquations;
class PickBlocks;
}

/// How a place of the surface is estimated from the picks around it.
struct LocalModel {
  int degree = 1;             ///< of the polynomial height over the tangent plane: 1 (plane), 2 (quadric) or 3 (cubic)
  std::size_t neighbors = 40; ///< picks of the same side it is fitted to
  double slope_weight = 0.0;  ///< of a measured slope (TangentPlanes::measured) against a height: (error of a height / error of a slope)^2
};

/// The model for places beyond the picks, as between them and a fault: carrying on asks for more picks and a lower degree than lying among them.
inline LocalModel beyondPicks(LocalModel model) {
  model.degree = model.degree < 2 ? model.degree : 2;
  model.neighbors *= 2;
  return model;
}

/// The estimate at a place.
struct LocalEstimate {
  bool valid = false;
  double offset = 0.0;                  ///< from the query along its normal to the surface
  Vector3 normal = Vector3::UnitZ();    ///< of the surface there
  double leverage = 0.0;                ///< weight that the pick asked for has in the estimate at its own foot, 0 to 1
};

/// A piece of surface about a place: a polynomial height over a plane.
struct LocalSurface {
  bool valid = false;
  Vector3 centre = Vector3::Zero();
  Vector3 u = Vector3::UnitX(); ///< u, v and normal: right-handed unit axes
  Vector3 v = Vector3::UnitY();
  Vector3 normal = Vector3::UnitZ();
  double radius = 1.0;                      ///< of the support, in the picks' units; heights are polynomials of u / radius and v / radius
  std::array<double, 10> coefficients{};    ///< of 1, u, v, u^2, u v, v^2, u^3, ...

  /// From a place along a unit direction to the surface, and the surface's normal there (on the direction's side).
  LocalEstimate from(const Vector3& place, const Vector3& direction) const;
};

/// A surface not yet fitted, over the plane through a place with that unit normal.
LocalSurface frameAt(const Vector3& centre, const Vector3& normal);

/// A weighted least-squares polynomial through the nearest picks on the same side of the faults: averages noise instead of copying it.
///
/// The support is a disc that holds the picks wanted, their weights fall smoothly to 0 at its rim. Picks that lie off all others there (blunders) are
/// left out. Where normals were measured (dips) the polynomial's slope is fitted to them too. Thread-safe; holds references. Cost per estimate: one
/// neighbour query, one test of sight per pick near faults, a few multiplications per pick.
class LocalFit {
public:
  /// \param[in] search_radius no pick farther than this is used, in the picks' units
  /// \param[in] mean_distance from pick to pick, as meanPickDistance() gives it; 0: it is asked
  LocalFit(const NeighborGrid& grid, const TangentPlanes& planes, const FaultNetwork& faults, double search_radius, double mean_distance = 0.0);

  /// What lies around several places.
  struct Surroundings {
    Bounds places;
    double radius = 0.0;    ///< all picks as near to a place are known
    bool no_faults = false; ///< none is as near
    std::shared_ptr<detail::PickBlocks> picks;
  };

  /// Working memory, kept by the caller from call to call; after gather() the picks found, one array per quantity.
  struct Scratch {
    Surroundings around; ///< of the last places looked around, see lookAround()
    std::vector<PointRun> runs;
    std::size_t count = 0;
    std::vector<double> u, v, height, squared; ///< in the frame of the plane given; distance squared within that plane
    std::vector<Index> index;
    std::vector<double> scaled_u, scaled_v, weight, residual, spare;
    double pace = 0.0; ///< radius per square root of a pick, of the last query
  };

  /// \param[in] at        where the estimate is wanted
  /// \param[in] viewpoint from where it is asked which picks lie on the same side (at itself, or a place just inside the sheet)
  /// \param[in] normal    unit direction to move along; picks whose normal is more than 70 degrees from it are left out
  /// \param[in] own       pick whose leverage is wanted, -1 for none
  LocalEstimate at(const Vector3& at, const Vector3& viewpoint, const Vector3& normal, const LocalModel& model, Scratch& scratch,
                   Index own = -1) const;

  /// Makes ready for supports of up to so many picks at places in a box: they then cost a fraction, and differ by no more than the order of sums.
  /// To be called for places not much farther from each other than supports are wide.
  void lookAround(const Bounds& places, std::size_t picks, Scratch& scratch) const;

  /// The surface about a place, over the plane with that normal; arguments as for at().
  LocalSurface around(const Vector3& centre, const Vector3& viewpoint, const Vector3& normal, const LocalModel& model, Scratch& scratch) const;

  /// The two halves of around(): the picks of the same side in a disc that holds the number wanted (or all in reach) ...
  /// \return the disc's radius; 0 if no pick is in reach
  double gather(LocalSurface& frame, const Vector3& viewpoint, std::size_t wanted, Scratch& scratch) const;
  /// ... and the polynomial through those within surface.radius.
  /// \param[in] own      pick whose leverage is wanted, -1 for none
  /// \return its leverage
  double solve(LocalSurface& surface, const LocalModel& model, Scratch& scratch, Index own = -1) const;

  /// Leaves out the picks gathered that lie beyond a radius: solve() in a part of a support then costs no more than the part.
  static void keepWithin(double radius, Scratch& scratch);

  static constexpr double kRim = 1.1; ///< squared radius of a disc that holds just the picks wanted, over that of the last one

  /// Radius of a disc that holds this many picks at the picks' usual density.
  double usualRadius(std::size_t picks) const { return pace_ * std::sqrt(static_cast<double>(picks)); }

  /// True if the pick's dip was measured.
  bool isMeasured(Index pick) const { return !measured_.empty() && measured_[static_cast<std::size_t>(pick)]; }

  const NeighborGrid& grid() const { return grid_; }
  const TangentPlanes& planes() const { return planes_; }
  const FaultNetwork& faults() const { return faults_; }
  const FaultBorders& borders() const { return *borders_; }

private:
  struct Support;
  void addSlopes(const LocalSurface& surface, double weight, const Scratch& scratch, Index own, detail::NormalEquations& equations) const;
  static Bounds boxOfPicks(const LocalSurface& frame, double radius, Scratch& scratch);
  void lookWithin(const Bounds& places, double radius, Scratch& scratch) const;
  void collect(const LocalSurface& frame, const Vector3& viewpoint, double radius, Scratch& scratch) const;

  const NeighborGrid& grid_;
  const TangentPlanes& planes_;
  const FaultNetwork& faults_;
  double search_radius_;
  std::shared_ptr<const FaultBorders> borders_;
  std::vector<bool> measured_; ///< for each pick whether its normal was measured; empty if none was
  double pace_;                ///< radius per square root of a pick, of the whole cloud
};

/// The models that predict left-out picks best: away from the faults, near them, and at the data's edge, where picks lie on one side only.
struct ModelChoice {
  LocalModel away;
  LocalModel near;
  double error_away = 0.0; ///< RMS of the left-out picks, noise included, in the picks' units
  double error_near = 0.0;
  LocalModel edge = {};
};

/// Chooses the support from the data by leave-one-out prediction of up to 2,400 picks of each kind, eight about a place: without noise few picks and
/// a high degree win and detail is kept; with noise more picks win until the surface's own curvature tells.
/// \param[in] zone_width picks within this distance of a fault count as near
ModelChoice chooseModels(const LocalFit& fit, double zone_width, unsigned threads);

struct RefineOptions {
  ModelChoice models;
  double zone_width = 0.0; ///< the near model is used within half of this distance from a fault
  double max_step = 0.0;   ///< longest move of a vertex in one pass
  unsigned passes = 2;
  unsigned threads = 0;
};

/// Moves every vertex onto the locally fitted surface of its own side: along its normal, or, on a fault, within the fault.
///
/// The mesh's normals are then those of the fitted surface at the vertices (where there are picks to say so), no longer those of the triangles.
/// Passes after the first move the vertices near faults only. Cost: in proportion to the picks and vertices, whatever the support.
void refine(CutMesh& cut, const LocalFit& fit, const RefineOptions& options);

/// The same where the mesh's corners are at hand.
void refine(CutMesh& cut, const VertexCorners& corners, const LocalFit& fit, const RefineOptions& options);

} // namespace graben
GRABEN_EXPORT_END
