#pragma once

#include "graben/faults/fault_surface.h"

namespace graben::detail {

/// Which way a stretch of a fault's border faces.
enum class BorderKind { Top, Right, Bottom, Left };

/// Border edges one after the other that face the same way, as half-edges 3 t + e in the direction
/// of their triangles.
struct BorderRun {
  BorderKind kind = BorderKind::Top;
  std::vector<Index> half_edges;
  bool closed = false; ///< the last edge ends where the first begins and the whole loop is one run

  bool lateral() const { return kind == BorderKind::Right || kind == BorderKind::Left; }
};

Index startOf(const TriangleMesh& mesh, Index half_edge);
Index endOf(const TriangleMesh& mesh, Index half_edge);
double edgeLength(const TriangleMesh& mesh, Index half_edge);

/// The vertices of a run in its order; the last is not the first again if the run is closed.
std::vector<Index> verticesOf(const TriangleMesh& mesh, const BorderRun& run);

/// Directions in the plane of a triangle.
struct DipFrame {
  Vector3 normal;
  Vector3 up;    ///< steepest way up
  Vector3 right; ///< along strike
};

class DipFrames {
public:
  explicit DipFrames(const TriangleMesh& mesh);
  DipFrame at(Index triangle) const;

private:
  const TriangleMesh& mesh_;
  Vector3 usual_up_; // for triangles too flat to have a dip of their own
};

/// The in-plane direction away from the surface at a border edge.
Vector3 outwardOf(const TriangleMesh& mesh, Index half_edge);

/// The runs of all border loops but holes. Every edge gets the way it faces, with turns that are
/// short against the fault's width left out (the labels of least cost around each loop). Edges on
/// the fault's tip lines are lateral.
std::vector<BorderRun> outerBorderRuns(const FaultSurface& fault);

/// One unit direction per vertex of the run: the mean of its edges' directions, weighted by length
/// and a Gaussian of the distance along the run; an infinite \a sigma gives all vertices the same
/// one.
Points directionsAlong(const TriangleMesh& mesh, const BorderRun& run,
                       const Points& edge_directions, double sigma);

} // namespace graben::detail
