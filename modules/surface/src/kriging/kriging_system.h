#pragma once

#include "kriged_rows.h"

#include <Eigen/SparseCore>

#include <map>

namespace graben::detail {

/// A pick that holds the surface.
struct KrigedPick {
  NodeBlend foot;        ///< the surface at the place of the mesh that is nearest to it
  double distance = 0.0; ///< from that place, along the mesh's normal there
};

/// The equations of some nodes of a surface, all others staying where they are; made once, solved for any correlation.
class KrigingSystem {
public:
  /// \param[in] lines of the picks; empty where none is off; \param[in] active the nodes; \param[in] rows theirs; \param[in] count of all nodes
  KrigingSystem(const std::vector<KrigedPick>& picks, const std::vector<std::vector<LineShare>>& lines, std::vector<Index> active, KrigedRows rows,
                std::size_t count);

  /// The moves of the active nodes, in their order; 0 where the equations cannot be solved. Thread-safe.
  /// \param[in] correlation its length in the picks' units; its mistie above 0 where there are lines
  Eigen::VectorXd moves(const SurfaceCorrelation& correlation) const;

  const std::vector<Index>& active() const { return active_; }

private:
  /// Rows of least squares as their normal equations.
  struct Normal {
    Eigen::SparseMatrix<double> matrix;
    Eigen::VectorXd right;
  };
  class Rows;

  Normal ofPicks(const std::vector<KrigedPick>& picks, const std::vector<std::vector<LineShare>>& lines);
  Normal ofHeights(const SurfaceCorrelation& correlation) const;

  Eigen::Index columns() const { return static_cast<Eigen::Index>(active_.size() + line_column_.size()); }

  std::vector<Index> active_;
  std::vector<Eigen::Index> column_; ///< of each node, -1 of one that stays
  std::map<Index, Eigen::Index> line_column_; ///< of lines, after the nodes'
  KrigedRows rows_;
  Normal picks_;
};

} // namespace graben::detail
