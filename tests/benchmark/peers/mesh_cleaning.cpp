#include "mesh_cleaning.h"

#include <cmath>
#include <unordered_map>

namespace graben::peer {
namespace {

using Cells = std::unordered_multimap<std::uint64_t, std::int32_t>;

std::uint64_t cellKey(std::int64_t x, std::int64_t y, std::int64_t z) {
  constexpr std::uint64_t kMask = (1U << 21U) - 1; // cells that share a key are told apart by the distance
  return (static_cast<std::uint64_t>(x) & kMask) << 42U | (static_cast<std::uint64_t>(y) & kMask) << 21U |
         (static_cast<std::uint64_t>(z) & kMask);
}

std::int64_t cell(float coordinate, double size) { return static_cast<std::int64_t>(std::floor(coordinate / size)); }

double squaredDistance(const Point& a, const Point& b) {
  double sum = 0;
  for (int axis = 0; axis < 3; ++axis)
    sum += (double(a[axis]) - b[axis]) * (double(a[axis]) - b[axis]);
  return sum;
}

/// A point of the cells around this one within the distance, or -1.
std::int32_t findNear(const Cells& cells, const std::vector<Point>& points, const Point& point, double distance) {
  const std::int64_t x = cell(point[0], distance), y = cell(point[1], distance), z = cell(point[2], distance);
  for (int i = 0; i < 27; ++i) {
    const int n = (i + 13) % 27; // the cell itself first
    const auto [begin, end] = cells.equal_range(cellKey(x + n % 3 - 1, y + n / 3 % 3 - 1, z + n / 9 - 1));
    for (auto it = begin; it != end; ++it)
      if (squaredDistance(points[it->second], point) <= distance * distance)
        return it->second;
  }
  return -1;
}

void insert(Cells& cells, const Point& point, double size, std::int32_t index) {
  cells.emplace(cellKey(cell(point[0], size), cell(point[1], size), cell(point[2], size)), index);
}

void dropUnusedVertices(Mesh& mesh) {
  std::vector<std::int32_t> renumbered(mesh.vertices.size(), -1);
  std::vector<Point> vertices;
  for (auto& triangle : mesh.triangles)
    for (std::int32_t& corner : triangle) {
      if (renumbered[corner] < 0) {
        renumbered[corner] = static_cast<std::int32_t>(vertices.size());
        vertices.push_back(mesh.vertices[corner]);
      }
      corner = renumbered[corner];
    }
  mesh.vertices.swap(vertices);
  mesh.normals.clear();
}

template <typename Keep>
void keepTriangles(Mesh& mesh, Keep keep) {
  std::size_t kept = 0;
  for (const auto& triangle : mesh.triangles)
    if (keep(triangle))
      mesh.triangles[kept++] = triangle;
  mesh.triangles.resize(kept);
  dropUnusedVertices(mesh);
}

} // namespace

void weldVertices(Mesh& mesh, double tolerance) {
  Cells cells;
  std::vector<std::int32_t> first(mesh.vertices.size());
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    first[i] = findNear(cells, mesh.vertices, mesh.vertices[i], tolerance);
    if (first[i] < 0) {
      first[i] = static_cast<std::int32_t>(i);
      insert(cells, mesh.vertices[i], tolerance, first[i]);
    }
  }
  for (auto& triangle : mesh.triangles)
    for (std::int32_t& corner : triangle)
      corner = first[corner];
  keepTriangles(mesh, [](const auto& t) { return t[0] != t[1] && t[1] != t[2] && t[2] != t[0]; });
}

void trimFarTriangles(Mesh& mesh, const std::vector<Point>& points, double distance) {
  Cells cells;
  for (std::size_t i = 0; i < points.size(); ++i)
    insert(cells, points[i], distance, static_cast<std::int32_t>(i));
  std::vector<char> near(mesh.vertices.size());
  for (std::size_t i = 0; i < near.size(); ++i)
    near[i] = findNear(cells, points, mesh.vertices[i], distance) >= 0;
  keepTriangles(mesh, [&](const auto& t) { return near[t[0]] && near[t[1]] && near[t[2]]; });
}

} // namespace graben::peer
