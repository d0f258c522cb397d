#pragma once

#include "plate_stencils.h"

#include "graben/surface/plate_fit.h"

#include <Eigen/SparseCore>

namespace graben::detail {

/// A pick that holds the plate.
struct PlateSpring {
  NodeBlend foot;        ///< the surface at the place of the mesh that is nearest to it
  double distance = 0.0; ///< from that place, along the mesh's normal there
  bool left_out = false; ///< for the choice of a stiffness
};

/// All that a plate is made of, about the surface as it is.
struct PlateParts {
  PlateNodes nodes;
  std::vector<PlateStencil> stencils;
  std::vector<StiffEdge> edges;
  std::vector<char> at_tip; ///< of each node: near the tip of a fault, where bending changes without bounds and is resisted itself
  std::vector<PlateSpring> springs;
  double tip_length = 0.0; ///< bending length there
  double density = 0.0; ///< springs per area
};

/// Which springs hold the plate.
enum class HeldBy { All, ThoseNotLeftOut };

/// The equations of some nodes of a plate, all others staying where they are; made once, solved for any stiffness.
class PlateSystem {
public:
  /// \param[in] active the nodes
  PlateSystem(const PlateParts& parts, std::vector<Index> active);

  /// The moves of the active nodes, in their order; 0 where the equations cannot be solved. Thread-safe. \param[in] stiffness its length in the picks' units
  Eigen::VectorXd moves(const PlateStiffness& stiffness, HeldBy held) const;

  const std::vector<Index>& active() const { return active_; }

private:
  /// Rows of least squares as their normal equations.
  struct Normal {
    Eigen::SparseMatrix<double> matrix;
    Eigen::VectorXd right;
  };
  class Rows;

  Normal springs(const PlateParts& parts, bool left_out) const;
  Normal bending(const PlateParts& parts, bool at_tip) const;
  Normal changes(const PlateParts& parts) const;

  std::vector<Index> active_;
  std::vector<Eigen::Index> column_; ///< of each node, -1 of one that stays
  double density_;
  double tip_length_;
  Normal held_, left_out_, bending_, bending_at_tips_, changes_;
};

} // namespace graben::detail
