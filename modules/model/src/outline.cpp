#include "outline.h"

#include "cell_fields.h"
#include "fault_tears.h"
#include "labelled_cells.h"

#include "graben/core/errors.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace graben {

namespace {

using Place = Eigen::Vector2d;

constexpr double kWarp = 0.3;
constexpr double kSnap = 0.08;
constexpr double kReach = 3.0; // sizes: how far from an edge of the outline, and beyond its ends, it is cut along

double cross(const Place& a, const Place& b) { return a.x() * b.y() - a.y() * b.x(); }

bool isInside(const std::vector<Place>& ring, const Place& p) {
  bool inside = false;
  for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++)
    if ((ring[i].y() > p.y()) != (ring[j].y() > p.y()) &&
        p.x() < ring[i].x() + (ring[j].x() - ring[i].x()) * (p.y() - ring[i].y()) / (ring[j].y() - ring[i].y()))
      inside = !inside;
  return inside;
}

class OutlineCutter {
public:
  OutlineCutter(TetrahedronMesh& mesh, const BlockModelOptions& options) : mesh_(mesh), o_(options) {}

  void run() {
    fixVerticesOnFaults();
    for (std::size_t i = 0; i < o_.outline.size(); ++i)
      cutAlong(o_.outline[i], o_.outline[(i + 1) % o_.outline.size()]);
    std::vector<std::uint8_t> kept(mesh_.cells.size());
    for (std::size_t c = 0; c < kept.size(); ++c) {
      Place middle = Place::Zero();
      for (const Index node : mesh_.cells[c])
        middle += 0.25 * mesh_.position(node).head<2>();
      kept[c] = isInside(o_.outline, middle) ? 1 : 0;
    }
    keepCells(mesh_, kept, [](std::size_t) { return kOutlineMark; }, o_.threads);
    if (mesh_.cells.empty())
      throw InvalidInputError("outline", "nothing of the model lies inside");
    markEdges();
    dropVertices();
  }

private:
  void fixVerticesOnFaults() {
    fixed_.assign(mesh_.vertices.size(), 0);
    for (std::size_t c = 0; c < mesh_.cells.size(); ++c)
      for (std::size_t f = 0; f < 4; ++f)
        for (const int corner : kTetrahedronFaces[f])
          if (mesh_.marks[c][f] >= 0)
            fixed_[static_cast<std::size_t>(mesh_.cells[c][static_cast<std::size_t>(corner)])] = 1;
  }

  void cutAlong(const Place& from, const Place& to) {
    const double length = (to - from).norm();
    const Place way = (to - from) / length;
    std::vector<double> field(mesh_.vertices.size(), std::numeric_limits<double>::quiet_NaN());
    const double reach = kReach * o_.size;
    for (std::size_t v = 0; v < field.size(); ++v) {
      const Place d = mesh_.vertices[v].head<2>() - from;
      const double along = d.dot(way), off = cross(way, d);
      if (std::abs(off) <= reach && along >= -reach && along <= length + reach)
        field[v] = std::abs(off) <= 1e-9 * o_.size ? 0.0 : off;
    }
    LevelCut cut;
    cut.field = &field;
    cut.fixed = &fixed_;
    cut.box = &o_.box;
    cut.warp = kWarp;
    cut.snap = 1e-9; // the wall stays a plane
    cut.threads = o_.threads;
    cutAtZero(mesh_, cut);
    fixed_.resize(mesh_.vertices.size(), 0);
    for (std::size_t v = 0; v < field.size(); ++v)
      if (field[v] == 0.0)
        fixed_[v] = 1;
  }

  /// Each edge of the outline is a wall of its own, so that its corners stay corners.
  void markEdges() {
    for (std::size_t c = 0; c < mesh_.cells.size(); ++c)
      for (std::size_t f = 0; f < 4; ++f) {
        std::int16_t& mark = mesh_.marks[c][f];
        if (mark != kOutlineMark)
          continue;
        Place middle = Place::Zero();
        for (const int corner : kTetrahedronFaces[f])
          middle += mesh_.position(mesh_.cells[c][static_cast<std::size_t>(corner)]).head<2>() / 3.0;
        mark = static_cast<std::int16_t>(kOutlineMark - static_cast<int>(nearestEdge(middle)));
      }
  }

  std::size_t nearestEdge(const Place& p) const {
    std::size_t nearest = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < o_.outline.size(); ++i) {
      const Place a = o_.outline[i], run = o_.outline[(i + 1) % o_.outline.size()] - a;
      const double t = std::clamp((p - a).dot(run) / run.squaredNorm(), 0.0, 1.0);
      const double distance = (p - a - t * run).squaredNorm();
      if (distance < least) {
        least = distance;
        nearest = i;
      }
    }
    return nearest;
  }

  void dropVertices() {
    std::vector<Index> place(mesh_.vertices.size(), -1);
    Points vertices;
    for (Tetrahedron& cell : mesh_.cells)
      for (Index& v : cell) {
        Index& to = place[static_cast<std::size_t>(v)];
        if (to < 0) {
          to = static_cast<Index>(vertices.size());
          vertices.push_back(mesh_.vertices[static_cast<std::size_t>(v)]);
        }
        v = to;
      }
    mesh_.vertices = std::move(vertices);
    mesh_.node_vertex.resize(mesh_.vertices.size());
    for (std::size_t v = 0; v < mesh_.vertices.size(); ++v)
      mesh_.node_vertex[v] = static_cast<Index>(v);
  }

  TetrahedronMesh& mesh_;
  const BlockModelOptions& o_;
  std::vector<std::uint8_t> fixed_; ///< vertices on faults and on the outline's earlier edges
};

} // namespace

TriangleMesh outlineWalls(const BlockModelOptions& options) {
  TriangleMesh walls;
  const double up = options.box.size().z();
  for (std::size_t i = 0; i < options.outline.size(); ++i) {
    const Place& a = options.outline[i];
    const Place& b = options.outline[(i + 1) % options.outline.size()];
    const auto first = static_cast<Index>(walls.vertices.size());
    for (const Place& p : {a, b})
      for (const double z : {options.box.low.z() - up, options.box.high.z() + up})
        walls.vertices.emplace_back(p.x(), p.y(), z);
    walls.triangles.push_back({first, first + 2, first + 1});
    walls.triangles.push_back({first + 2, first + 3, first + 1});
  }
  return walls;
}

void cutToOutline(TetrahedronMesh& mesh, const BlockModelOptions& options) {
  if (!options.outline.empty())
    OutlineCutter(mesh, options).run();
}

} // namespace graben
