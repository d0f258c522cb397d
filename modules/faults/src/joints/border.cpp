#include "joints/border.h"

#include "graben/mesh/adjacency.h"
#include "graben/mesh/components.h"
#include "graben/mesh/normals.h"
#include "graben/mesh/triangle_bvh.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace graben::detail {
namespace {

constexpr double kFlat = 0.05;     // sine of the dip under which a triangle has none
constexpr double kTurnCost = 0.15; // of the fault's width: stretches shorter than about this do not
                                   // change the way a border faces
constexpr double kOnLine = 1e-6;   // of a border edge: how far off a tip line it may lie
constexpr double kHole = -0.3;     // an outline facing its own centre this much is a hole's
constexpr std::size_t kKinds = 4;
constexpr std::size_t kManyEdges = 2000; // of a run
constexpr double kShortBlock = 0.05;     // of the reach that directions are averaged over

Index nextInTriangle(Index h) {
  return h % 3 == 2 ? h - 2 : h + 1;
}

Vector3 unit(const Vector3& v, const Vector3& otherwise) {
  const double length = v.norm();
  return length > 0.0 ? Vector3(v / length) : otherwise;
}

std::vector<std::vector<Index>> halfEdgeLoops(const TriangleMesh& mesh,
                                              const EdgeAdjacency& adjacency) {
  std::vector<std::vector<Index>> loops;
  const auto count = static_cast<Index>(3 * mesh.triangles.size());
  std::vector<bool> done(static_cast<std::size_t>(count), false);
  for (Index start = 0; start < count; ++start) {
    if (!adjacency.isBorder(start) || done[static_cast<std::size_t>(start)])
      continue;
    loops.emplace_back();
    for (Index h = start; !done[static_cast<std::size_t>(h)];) {
      done[static_cast<std::size_t>(h)] = true;
      loops.back().push_back(h);
      for (h = nextInTriangle(h); adjacency.twin(h) >= 0;)
        h = nextInTriangle(adjacency.twin(h));
    }
  }
  return loops;
}

bool isHole(const TriangleMesh& mesh, const std::vector<Index>& loop) {
  Vector3 centre = Vector3::Zero();
  double perimeter = 0.0;
  const auto middle = [&mesh](Index h) {
    return Vector3(0.5 * (mesh.vertices[static_cast<std::size_t>(startOf(mesh, h))] +
                          mesh.vertices[static_cast<std::size_t>(endOf(mesh, h))]));
  };
  for (const Index h : loop) {
    centre += edgeLength(mesh, h) * middle(h);
    perimeter += edgeLength(mesh, h);
  }
  centre /= perimeter;
  double facing = 0.0;
  double most = 0.0;
  for (const Index h : loop) {
    facing += edgeLength(mesh, h) * (middle(h) - centre).dot(outwardOf(mesh, h));
    most += edgeLength(mesh, h) * (middle(h) - centre).norm();
  }
  return facing < kHole * most;
}

using KindCosts = std::array<double, kKinds>;

/// The tip lines of a fault, to be asked whether an edge lies on one.
class TipLines {
public:
  explicit TipLines(const FaultSurface& fault) : mesh_(fault.mesh) {
    for (const Points& line : fault.tip_lines) {
      TriangleMesh segments;
      segments.vertices = line;
      for (Index i = 0; i + 1 < static_cast<Index>(line.size()); ++i)
        segments.triangles.push_back({i, i + 1, i + 1});
      lines_.emplace_back(segments, 1);
    }
  }

  bool hold(Index half_edge) const {
    const double tolerance = kOnLine * edgeLength(mesh_, half_edge);
    const auto near = [&](const TriangleBvh& line, Index v) {
      return line.nearest(mesh_.vertices[static_cast<std::size_t>(v)], 2.0 * tolerance).distance <= tolerance;
    };
    return std::any_of(lines_.begin(), lines_.end(), [&](const TriangleBvh& line) {
      return near(line, startOf(mesh_, half_edge)) && near(line, endOf(mesh_, half_edge));
    });
  }

private:
  const TriangleMesh& mesh_;
  std::vector<TriangleBvh> lines_;
};

KindCosts costsOf(const TriangleMesh& mesh, const TipLines& tips, const DipFrames& frames, Index half_edge) {
  const DipFrame frame = frames.at(half_edge / 3);
  const Vector3 outward = outwardOf(mesh, half_edge);
  const double length = edgeLength(mesh, half_edge);
  const double up = outward.dot(frame.up);
  const double right = outward.dot(frame.right);
  if (tips.hold(half_edge)) {
    const double never = std::numeric_limits<double>::max() * 1e-9;
    return {never, right > 0.0 ? 0.0 : never, never, right > 0.0 ? never : 0.0};
  }
  return {length * (1.0 - up), length * (1.0 - right), length * (1.0 + up), length * (1.0 + right)};
}

/// The kinds of least cost around a loop whose first edge has kind \a first.
std::vector<std::size_t> cheapestKinds(const std::vector<KindCosts>& costs, std::size_t first,
                                       double turn_cost) {
  std::vector<std::array<std::size_t, kKinds>> came_from(costs.size());
  KindCosts sum;
  sum.fill(std::numeric_limits<double>::infinity());
  sum[first] = costs[0][first];
  for (std::size_t e = 1; e < costs.size(); ++e) {
    KindCosts next;
    for (std::size_t k = 0; k < kKinds; ++k) {
      std::size_t best = k;
      for (std::size_t j = 0; j < kKinds; ++j)
        if (sum[j] + turn_cost < sum[best] + (best == k ? 0.0 : turn_cost))
          best = j;
      came_from[e][k] = best;
      next[k] = sum[best] + (best == k ? 0.0 : turn_cost) + costs[e][k];
    }
    sum = next;
  }
  std::size_t last = first;
  for (std::size_t k = 0; k < kKinds; ++k)
    if (sum[k] + turn_cost < sum[last] + (last == first ? 0.0 : turn_cost))
      last = k;
  std::vector<std::size_t> kinds(costs.size());
  for (std::size_t e = costs.size(); e-- > 0;) {
    kinds[e] = last;
    last = came_from[e][last];
  }
  return kinds;
}

/// Cuts a loop into runs where the kind changes and at edges that are not on the border
/// (non-manifold ones).
void addRuns(const std::vector<Index>& loop, const std::vector<std::size_t>& kinds,
             const EdgeAdjacency& adjacency, std::vector<BorderRun>& runs) {
  const std::size_t n = loop.size();
  const auto breaks = [&](std::size_t e) { // between edge e and the one before
    const std::size_t previous = (e + n - 1) % n;
    return kinds[e] != kinds[previous] || !adjacency.isBorder(loop[e]) ||
           !adjacency.isBorder(loop[previous]);
  };
  std::size_t start = 0;
  while (start < n && !breaks(start))
    ++start;
  if (start == n) {
    runs.push_back({static_cast<BorderKind>(kinds[0]), loop, true});
    return;
  }
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t e = (start + k) % n;
    if (!adjacency.isBorder(loop[e]))
      continue;
    if (breaks(e))
      runs.push_back({static_cast<BorderKind>(kinds[e]), {}, false});
    runs.back().half_edges.push_back(loop[e]);
  }
}

} // namespace

Index startOf(const TriangleMesh& mesh, Index h) {
  return mesh.triangles[static_cast<std::size_t>(h / 3)][static_cast<std::size_t>(h % 3)];
}

Index endOf(const TriangleMesh& mesh, Index h) {
  return startOf(mesh, nextInTriangle(h));
}

double edgeLength(const TriangleMesh& mesh, Index h) {
  return (mesh.vertices[static_cast<std::size_t>(endOf(mesh, h))] -
          mesh.vertices[static_cast<std::size_t>(startOf(mesh, h))])
      .norm();
}

std::vector<Index> verticesOf(const TriangleMesh& mesh, const BorderRun& run) {
  std::vector<Index> vertices;
  for (const Index h : run.half_edges)
    vertices.push_back(startOf(mesh, h));
  if (!run.closed)
    vertices.push_back(endOf(mesh, run.half_edges.back()));
  return vertices;
}

DipFrames::DipFrames(const TriangleMesh& mesh)
    : mesh_(mesh) {
  Vector3 sum = Vector3::Zero();
  for (const Triangle& t : mesh.triangles) {
    const Vector3 area = areaNormal(mesh, t);
    const Vector3 n = unit(area, Vector3::UnitZ());
    sum += area.norm() * (Vector3::UnitZ() - n.z() * n);
  }
  usual_up_ = unit(sum, Vector3::UnitY());
}

DipFrame DipFrames::at(Index triangle) const {
  DipFrame frame;
  frame.normal = unit(areaNormal(mesh_, mesh_.triangles[static_cast<std::size_t>(triangle)]),
                      Vector3::UnitZ());
  Vector3 up = Vector3::UnitZ() - frame.normal.z() * frame.normal;
  if (up.norm() < kFlat)
    up = usual_up_ - usual_up_.dot(frame.normal) * frame.normal;
  frame.up = unit(up, frame.normal.unitOrthogonal());
  frame.right = frame.normal.cross(frame.up);
  return frame;
}

Vector3 outwardOf(const TriangleMesh& mesh, Index h) {
  const Vector3 along = mesh.vertices[static_cast<std::size_t>(endOf(mesh, h))] -
                        mesh.vertices[static_cast<std::size_t>(startOf(mesh, h))];
  return unit(along.cross(areaNormal(mesh, mesh.triangles[static_cast<std::size_t>(h / 3)])),
              Vector3::Zero());
}

std::vector<BorderRun> outerBorderRuns(const FaultSurface& fault) {
  const TriangleMesh& mesh = fault.mesh;
  const EdgeAdjacency adjacency(mesh);
  const Components components = connectedComponents(mesh);
  std::vector<double> area(components.triangle_count.size(), 0.0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    area[static_cast<std::size_t>(components.of_triangle[t])] +=
        0.5 * areaNormal(mesh, mesh.triangles[t]).norm();
  const DipFrames frames(mesh);
  const TipLines tips(fault);
  std::vector<BorderRun> runs;
  for (const std::vector<Index>& loop : halfEdgeLoops(mesh, adjacency)) {
    if (isHole(mesh, loop))
      continue;
    std::vector<KindCosts> costs;
    double perimeter = 0.0;
    for (const Index h : loop) {
      costs.push_back(costsOf(mesh, tips, frames, h));
      perimeter += edgeLength(mesh, h);
    }
    const double width = 2.0 *
                         area[static_cast<std::size_t>(
                             components.of_triangle[static_cast<std::size_t>(loop[0] / 3)])] /
                         perimeter;
    // The loop starts at the longest edge that faces one way, whose kind is certain.
    std::size_t surest = 0;
    const auto clearness = [&costs](std::size_t e) {
      return -*std::min_element(costs[e].begin(), costs[e].end()) +
             *std::max_element(costs[e].begin(), costs[e].end());
    };
    for (std::size_t e = 1; e < loop.size(); ++e)
      if (clearness(e) > clearness(surest))
        surest = e;
    std::vector<Index> turned = loop;
    std::rotate(turned.begin(), turned.begin() + static_cast<std::ptrdiff_t>(surest), turned.end());
    std::rotate(costs.begin(), costs.begin() + static_cast<std::ptrdiff_t>(surest), costs.end());
    const auto first = static_cast<std::size_t>(std::min_element(costs[0].begin(), costs[0].end()) -
                                                costs[0].begin());
    addRuns(turned, cheapestKinds(costs, first, kTurnCost * width), adjacency, runs);
  }
  return runs;
}

namespace {

/// Edges of a run that follow each other, as one: where they lie along it, and the sum of their directions.
struct Block {
  double begin, end;
  Vector3 sum;
};

/// One for each edge of a short run, and of a long one for stretches that are short against \a sigma: time must not grow with the square of the edges.
std::vector<Block> blocksOf(const std::vector<double>& ends, const Points& edge_directions, double sigma) {
  const double most = edge_directions.size() > kManyEdges ? kShortBlock * sigma : 0.0;
  std::vector<Block> blocks;
  for (std::size_t e = 0; e < edge_directions.size(); ++e) {
    const Vector3 share = (ends[e + 1] - ends[e]) * edge_directions[e];
    if (blocks.empty() || !(ends[e + 1] - blocks.back().begin < most))
      blocks.push_back({ends[e], ends[e + 1], share});
    else
      blocks.back() = {blocks.back().begin, ends[e + 1], blocks.back().sum + share};
  }
  return blocks;
}

} // namespace

Points directionsAlong(const TriangleMesh& mesh, const BorderRun& run,
                       const Points& edge_directions, double sigma) {
  const std::size_t edges = run.half_edges.size();
  std::vector<double> ends{
      0.0}; // distance along the run where each edge starts, and the whole length
  for (const Index h : run.half_edges)
    ends.push_back(ends.back() + edgeLength(mesh, h));
  const double total = ends.back();
  const std::vector<Block> blocks = blocksOf(ends, edge_directions, sigma);
  Points directions;
  for (std::size_t v = 0; v < edges + (run.closed ? 0 : 1); ++v) {
    Vector3 sum = Vector3::Zero();
    for (const Block& block : blocks) {
      double away = std::max({0.0, block.begin - ends[v], ends[v] - block.end});
      if (run.closed)
        away = std::min(away, std::max(0.0, total - std::max(block.end - ends[v], ends[v] - block.begin)));
      sum += (std::isfinite(sigma) ? std::exp(-0.5 * (away / sigma) * (away / sigma)) : 1.0) * block.sum;
    }
    directions.push_back(unit(sum, edge_directions[std::min(v, edges - 1)]));
  }
  return directions;
}

} // namespace graben::detail
