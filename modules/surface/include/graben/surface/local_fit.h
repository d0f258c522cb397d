#pragma once

#include "graben/features/tangent_planes.h"
#include "graben/surface/cut_mesh.h"

namespace graben {

/// How a place of the surface is estimated from the picks around it.
struct LocalModel {
  int degree = 1;             ///< of the polynomial height over the tangent plane: 1 (plane) or 2 (quadric)
  std::size_t neighbors = 40; ///< picks of the same side it is fitted to
};

/// The estimate at a place.
struct LocalEstimate {
  bool valid = false;
  double offset = 0.0;                  ///< from the query along its normal to the surface
  Vector3 normal = Vector3::UnitZ();    ///< of the surface there
  double leverage = 0.0;                ///< weight that the pick asked for has in the estimate at its own foot, 0 to 1
};

/// A weighted least-squares polynomial through the nearest picks on the same side of the faults: averages noise instead of copying it.
///
/// Thread-safe; holds references. Cost per estimate: one neighbour query, one crossing test per pick near faults, one 6 x 6 solve.
class LocalFit {
public:
  LocalFit(const NeighborGrid& grid, const TangentPlanes& planes, const FaultNetwork& faults, double search_radius);

  struct Scratch {
    std::vector<Neighbor> candidates;
    std::vector<Neighbor> picks;
  };

  /// \param[in] at        where the estimate is wanted
  /// \param[in] viewpoint from where it is asked which picks lie on the same side (at itself, or a place just inside the sheet)
  /// \param[in] normal    unit direction to move along; picks whose normal is more than 70 degrees from it are left out
  /// \param[in] own       pick whose leverage is wanted, -1 for none
  LocalEstimate at(const Vector3& at, const Vector3& viewpoint, const Vector3& normal, const LocalModel& model, Scratch& scratch,
                   Index own = -1) const;

  const NeighborGrid& grid() const { return grid_; }
  const TangentPlanes& planes() const { return planes_; }
  const FaultNetwork& faults() const { return faults_; }

private:
  void gather(const Vector3& at, const Vector3& viewpoint, const Vector3& normal, std::size_t count, Scratch& scratch) const;

  const NeighborGrid& grid_;
  const TangentPlanes& planes_;
  const FaultNetwork& faults_;
  double search_radius_;
};

/// The models that predict left-out picks best: one away from the faults and one near them, where picks lie on one side only.
struct ModelChoice {
  LocalModel away;
  LocalModel near;
  double error_away = 0.0; ///< RMS of the left-out picks, noise included, in the picks' units
  double error_near = 0.0;
};

/// Chooses the support from the data by leave-one-out prediction of up to 2,000 picks of each kind: without noise few picks and a quadric win and detail
/// is kept; with noise more picks win until the surface's own curvature tells.
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
void refine(CutMesh& cut, const LocalFit& fit, const RefineOptions& options);

} // namespace graben
