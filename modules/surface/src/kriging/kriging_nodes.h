#pragma once

#include "graben/mesh/vertex_corners.h"
#include "graben/surface/cut_mesh.h"

#include <Eigen/Core>

#include <vector>

namespace graben::detail {

/// Vertices of a surface, evenly spread, by which a smooth move of all of it is told: way for way through the surface, never across a cut.
struct KrigingNodes {
  std::vector<Index> vertex;               ///< of each node
  std::vector<Index> nearest;              ///< node of each vertex of the mesh; -1 of one without triangles
  std::vector<std::vector<Index>> beside;  ///< nodes whose vertices touch those of a node, in rising order
  std::vector<double> area;                ///< of a node's vertices

  std::size_t count() const { return vertex.size(); }

  /// Nodes around one, ring by ring, itself first: so many, or all within two rings where these are fewer.
  std::vector<Index> around(Index node, std::size_t most) const;
};

/// \param[in] spacing no two nodes are nearer to each other along the surface, about
KrigingNodes krigingNodes(const CutMesh& cut, const VertexCorners& corners, double spacing);

/// The share of a node in what a place does.
struct NodeShare {
  Index node;
  double share;
};

/// The surface at a place as nodes have it.
struct NodeBlend {
  std::vector<NodeShare> shares; ///< of the nodes' moves along their normals in that of the surface along a normal at the place
  double height = 0.0;           ///< of the surface through the nodes as they are over the place, along that normal

  double moved(const Eigen::VectorXd& moves) const;
};

/// By a quadric through the nodes around; by a plane, or the nearest node alone, where these are too few.
NodeBlend blendAt(const TriangleMesh& mesh, const Points& normals, const KrigingNodes& nodes, Index nearest, const Vector3& place, const Vector3& normal);

} // namespace graben::detail
