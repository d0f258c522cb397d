#pragma once

#include "kriged_rows.h"

#include <Eigen/SparseCore>

namespace graben::detail {

/// A pick that holds the surface.
struct KrigedPick {
  NodeBlend foot;        ///< the surface at the place of the mesh that is nearest to it
  double distance = 0.0; ///< from that place, along the mesh's normal there
};

/// The equations of some nodes of a surface, all others staying where they are; made once, solved for any correlation.
class KrigingSystem {
public:
  /// \param[in] active the nodes; \param[in] rows theirs; \param[in] count of all nodes
  KrigingSystem(const std::vector<KrigedPick>& picks, std::vector<Index> active, KrigedRows rows, std::size_t count);

  /// The moves of the active nodes, in their order; 0 where the equations cannot be solved. Thread-safe. \param[in] correlation its length in the picks' units
  Eigen::VectorXd moves(const SurfaceCorrelation& correlation) const;

  /// Twice the negative logarithm of how likely the picks' distances are under a correlation, up to a constant; infinite where it cannot be told. Thread-safe.
  double unlikeliness(const SurfaceCorrelation& correlation) const;

  const std::vector<Index>& active() const { return active_; }

private:
  /// Rows of least squares as their normal equations.
  struct Normal {
    Eigen::SparseMatrix<double> matrix;
    Eigen::VectorXd right;
    double squares = 0.0;   ///< of the rows' right hand sides
    Eigen::Index count = 0; ///< of the rows
  };
  class Rows;

  Normal ofPicks(const std::vector<KrigedPick>& picks) const;
  /// \param[out] log_determinant of the precision of the heights
  Normal ofHeights(const SurfaceCorrelation& correlation, double& log_determinant) const;

  std::vector<Index> active_;
  std::vector<Eigen::Index> column_; ///< of each node, -1 of one that stays
  KrigedRows rows_;
  Normal picks_;
};

} // namespace graben::detail
