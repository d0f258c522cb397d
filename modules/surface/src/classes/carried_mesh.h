#pragma once

#include "graben/mesh/triangle_mesh.h"

#include <pcl/PolygonMesh.h>

namespace graben {

/// A pcl::PolygonMesh as a TriangleMesh, and what it takes to write the mesh back with all its
/// fields after vertices have been moved and added.
///
/// While it is under way, a vertex's piece label is the point it came from, and its scalars hold
/// the fields to interpolate, those of eight bytes as two scalars.
class CarriedMesh {
public:
  /// \throw InvalidInputError if the mesh cannot be read, see fromPolygonMesh
  explicit CarriedMesh(const pcl::PolygonMesh& input);

  /// The mesh to work on; empty afterwards.
  TriangleMesh takeMesh() { return std::move(mesh_); }

  /// Writes the result: the first vertices are those of the mesh taken, with new places and
  /// normals; the rest have the fields carried along. The header of \a out is left as it is.
  void write(const TriangleMesh& result, pcl::PolygonMesh& out) const;

private:
  enum class Kind { Float, Double, Channel };
  /// A value of a point that is interpolated.
  struct Carrier {
    Kind kind = Kind::Float;
    std::size_t offset = 0;
    std::string name; ///< of its scalar
  };

  void compact();
  void addNormalFields();
  void findCarriers();
  void addCarriers(const pcl::PCLPointField& field, Kind kind, std::size_t count, std::size_t size);
  void fillCarriers();
  void writeCarrier(const Carrier& carrier, const TriangleMesh& result, std::size_t first,
                    pcl::PCLPointCloud2& cloud) const;

  TriangleMesh mesh_;
  pcl::PCLPointCloud2 points_; ///< finite points only, without padding, with normal fields
  std::vector<Carrier> carriers_;
};

} // namespace graben
