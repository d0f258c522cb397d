#include "graben/pipeline/horizon_mesh.h"

#include "graben/core/errors.h"
#include "graben/mesh/conversions.h"
#include "graben/surface/nearest_in_sight.h"

#include <pcl/common/io.h>

#include <algorithm>
#include <cstring>
#include <limits>

namespace graben {

namespace {

/// The cloud without its fields of these names; the bytes stay where they are.
pcl::PCLPointCloud2 withoutFields(const pcl::PCLPointCloud2& cloud, const std::vector<std::string>& names) {
  pcl::PCLPointCloud2 rest = cloud;
  const auto named = [&](const pcl::PCLPointField& f) { return std::find(names.begin(), names.end(), f.name) != names.end(); };
  rest.fields.erase(std::remove_if(rest.fields.begin(), rest.fields.end(), named), rest.fields.end());
  return rest;
}

bool hasField(const pcl::PCLPointCloud2& cloud, const std::string& name) {
  return std::any_of(cloud.fields.begin(), cloud.fields.end(), [&](const pcl::PCLPointField& f) { return f.name == name; });
}

pcl::PCLPointCloud2 rowsOf(const pcl::PCLPointCloud2& cloud, const std::vector<std::size_t>& rows) {
  pcl::PCLPointCloud2 some = cloud;
  some.data.resize(rows.size() * cloud.point_step);
  for (std::size_t i = 0; i < rows.size(); ++i)
    std::memcpy(some.data.data() + i * cloud.point_step, cloud.data.data() + rows[i] * cloud.point_step, cloud.point_step);
  some.height = 1;
  some.width = static_cast<std::uint32_t>(rows.size());
  some.row_step = some.width * some.point_step;
  return some;
}

/// The part of a mesh that has these vertices, in rising order.
TriangleMesh partOf(const TriangleMesh& mesh, const std::vector<std::size_t>& vertices, std::vector<Index>& place) {
  TriangleMesh part;
  const auto take = [&](const auto& all, auto& some) {
    for (std::size_t i = 0; i < vertices.size() && !all.empty(); ++i)
      some.push_back(all[vertices[i]]);
  };
  take(mesh.vertices, part.vertices);
  take(mesh.normals, part.normals);
  take(mesh.piece, part.piece);
  for (const auto& [name, values] : mesh.scalars)
    take(values, part.scalars[name]);
  for (std::size_t i = 0; i < vertices.size(); ++i)
    place[vertices[i]] = static_cast<Index>(i);
  return part;
}

} // namespace

std::vector<Index> picksOfVertices(const ReconstructionResult& result, unsigned threads) {
  const double scale = result.frame.z_scale;
  const auto stretched = [scale](Vector3 p) {
    p.z() *= scale;
    return p;
  };
  Points picks = result.picks;
  for (std::size_t i = 0; i < picks.size(); ++i)
    picks[i] = result.pick_reason[i] == PickReason::Good ? stretched(picks[i]) : Vector3(Vector3::Constant(std::numeric_limits<double>::quiet_NaN()));
  CutMesh cut{result.mesh, result.vertex_faults};
  for (Vector3& v : cut.mesh.vertices)
    v = stretched(v);
  std::vector<FaultSurface> faults = result.faults;
  for (FaultSurface& fault : faults)
    for (Vector3& v : fault.mesh.vertices)
      v = stretched(v);
  return picksOfVertices(cut, VertexCorners(cut.mesh, threads), NeighborGrid(picks, 0.0, threads), FaultNetwork(std::move(faults)), threads);
}

void toPolygonMesh(const TriangleMesh& mesh, const pcl::PCLPointCloud2& carried, pcl::PolygonMesh& out) {
  toPolygonMesh(mesh, out);
  if (carried.data.empty())
    return;
  pcl::PCLPointCloud2 joined;
  const pcl::PCLPointCloud2 own = hasField(carried, "label") ? withoutFields(out.cloud, {"label"}) : out.cloud;
  if (!pcl::concatenateFields(withoutFields(carried, {"x", "y", "z", "normal_x", "normal_y", "normal_z", "curvature"}), own, joined))
    throw InvalidInputError("carrying fields over", "The points' fields cannot be joined with the mesh's.");
  joined.header = out.cloud.header;
  out.cloud = std::move(joined);
}

std::vector<pcl::PolygonMesh> piecesOf(const TriangleMesh& mesh, const pcl::PCLPointCloud2& carried) {
  const Index last = mesh.piece.empty() ? -1 : *std::max_element(mesh.piece.begin(), mesh.piece.end());
  std::vector<std::vector<std::size_t>> vertices(static_cast<std::size_t>(last + 1));
  for (std::size_t v = 0; v < mesh.piece.size(); ++v)
    vertices[static_cast<std::size_t>(mesh.piece[v])].push_back(v);
  std::vector<Index> place(mesh.vertices.size(), -1);
  std::vector<TriangleMesh> parts;
  for (const std::vector<std::size_t>& of_piece : vertices)
    parts.push_back(partOf(mesh, of_piece, place));
  for (const Triangle& t : mesh.triangles) {
    Triangle moved{};
    std::transform(t.begin(), t.end(), moved.begin(), [&](Index v) { return place[static_cast<std::size_t>(v)]; });
    parts[static_cast<std::size_t>(mesh.piece[static_cast<std::size_t>(t[0])])].triangles.push_back(moved);
  }
  std::vector<pcl::PolygonMesh> pieces(parts.size());
  for (std::size_t p = 0; p < parts.size(); ++p)
    toPolygonMesh(parts[p], carried.data.empty() ? carried : rowsOf(carried, vertices[p]), pieces[p]);
  return pieces;
}

} // namespace graben
