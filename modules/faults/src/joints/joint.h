#pragma once

#include "joints/border.h"
#include "graben/faults/fault_network.h"
#include "joints/signed_surface.h"

#include "graben/mesh/vertex_corners.h"

namespace graben::detail {

/// Joins one fault (the branch) to one other (the main fault) wherever it ends there.
class Joint {
public:
  /// Lateral borders near the main fault are split finely first, so that a border may meet it in
  /// part only.
  Joint(const FaultSurface& branch, const SignedSurface& main, double reach);

  /// \return one entry per joined part of the border, fault indices unset; none: not a branch of
  /// this main fault
  std::vector<FaultBranch> join();

  /// The branch after join().
  FaultSurface takeFault() { return std::move(fault_); }

private:
  /// Where the branch's plane, continued from a border vertex, meets the main fault.
  struct Meeting {
    bool met = false;
    double along =
        0.0; ///< distance outward; negative: the border lies beyond the main fault already
    double facing = 1.0; ///< sine of the angle between the branch and the main fault
    int side = 0;        ///< side of the main fault the branch comes from
  };

  struct BorderPoint {
    Vector3 inner = Vector3::Zero();
    Vector3 direction = Vector3::Zero(); ///< outward, unit
    Meeting meeting;
  };

  /// Part of a border run all of which meets the main fault from one side: half-edges and one point
  /// more.
  struct Stretch {
    std::vector<Index> half_edges;
    std::vector<BorderPoint> points;
    int side = 0;
    double length = 0.0;
    double within_reach = 0.0; ///< length whose meetings lie within the reach
    bool touches = true;       ///< all of it lies on the main fault
    double farthest = 0.0;     ///< largest distance outward to the main fault
  };

  void splitNearBorders();
  bool nearMain(const BorderRun& run) const;
  Meeting meet(const Vector3& from, const Vector3& direction) const;
  std::vector<Stretch> stretches() const;
  void addStretches(const BorderRun& run, const std::vector<BorderPoint>& points,
                    std::vector<Stretch>& result) const;
  void addEdge(Stretch& stretch, Index half_edge, const BorderPoint& end) const;

  bool clip(const Stretch& stretch, const VertexCorners& corners);
  void clipOvershoots(std::vector<FaultBranch>& branches);

  double widthAt(const Meeting& meeting) const;
  Vector3 outerOf(const BorderPoint& point) const;
  void refine(const BorderPoint& a, const BorderPoint& b, int depth,
              std::vector<BorderPoint>& between) const;
  void extend(const std::vector<Stretch>& stretches);

  FaultSurface fault_;
  TriangleMesh& mesh_;
  const SignedSurface& main_;
  double reach_;
  double overshoot_;
};

} // namespace graben::detail
