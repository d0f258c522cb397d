#include "model_impl.h"
#include "roots.h"

#include <map>
#include <optional>
#include <tuple>
#include <unordered_map>

namespace graben {
namespace synthetic {
namespace {

/// A vertex of the triangulation and what it must stay on.
struct Corner {
  Vector2 position;
  bool on_x_edge = false; ///< x is plus or minus half the size
  bool on_y_edge = false;
  bool fixed = false;
  unsigned cuts = 0; ///< bit i: lies on the cutoff at fault i
};

/// A triangle grid over the area, cut by one fault after the other.
class SheetMesher {
public:
  SheetMesher(const Structure& structure, const Sheet& sheet, double resolution)
      : structure_(structure)
      , sheet_(sheet)
      , cells_(std::max(2, static_cast<int>(std::ceil(structure.size / resolution))))
      , step_(structure.size / cells_) {}

  SheetMesh run() {
    makeGrid();
    for (std::size_t i = 0; i < structure_.faults.size(); ++i)
      if (sheet_.side[i] != 0) {
        snap(i);
        clip(i);
      }
    SheetMesh mesh;
    for (const Corner& corner : corners_)
      mesh.positions.push_back(corner.position);
    mesh.triangles = std::move(triangles_);
    return mesh;
  }

private:
  Index gridIndex(int column, int row) const {
    return static_cast<Index>(row * (cells_ + 1) + column);
  }

  double coordinate(int k) const {
    return k == cells_ ? 0.5 * structure_.size : -0.5 * structure_.size + k * step_;
  }

  void makeGrid() {
    for (int row = 0; row <= cells_; ++row)
      for (int column = 0; column <= cells_; ++column)
        corners_.push_back({{coordinate(column), coordinate(row)},
                            column == 0 || column == cells_,
                            row == 0 || row == cells_,
                            false,
                            0});
    const std::vector<Index> tips = placeTips();
    const auto isTip = [&](Index v) {
      return std::find(tips.begin(), tips.end(), v) != tips.end();
    };
    for (int row = 0; row < cells_; ++row)
      for (int column = 0; column < cells_; ++column) {
        const Index a = gridIndex(column, row), b = a + 1, c = gridIndex(column + 1, row + 1),
                    d = c - 1;
        // A moved vertex may lie on the other diagonal of its cell.
        const bool along_ac =
            isTip(a) || isTip(c) || (!isTip(b) && !isTip(d) && (row + column) % 2 == 0);
        if (along_ac) {
          triangles_.push_back({a, b, c});
          triangles_.push_back({a, c, d});
        } else {
          triangles_.push_back({a, b, d});
          triangles_.push_back({b, c, d});
        }
      }
  }

  /// Moves the nearest grid vertex to each tip.
  std::vector<Index> placeTips() {
    std::vector<Index> moved;
    for (std::size_t i = 0; i < structure_.faults.size(); ++i) {
      const SyntheticFault& fault = structure_.faults[i];
      if (fault.tip_direction == 0 || sheet_.side[i] == 0)
        continue;
      const Vector2 tip = fault.toMap(fault.tip);
      const auto nearest = [&](double x) {
        return std::clamp(static_cast<int>(std::lround((x + 0.5 * structure_.size) / step_)), 1,
                          cells_ - 1);
      };
      const Index v = gridIndex(nearest(tip.x()), nearest(tip.y()));
      Corner& corner = corners_[static_cast<std::size_t>(v)];
      corner.position = tip;
      corner.cuts |= 1u << i;
      corner.fixed = true;
      moved.push_back(v);
    }
    return moved;
  }

  double inside(std::size_t fault, const Vector2& xy) const {
    return structure_.inside(sheet_, fault, xy);
  }

  double inside(std::size_t fault, const Corner& corner) const {
    return (corner.cuts >> fault & 1u) != 0 ? 0.0 : inside(fault, corner.position);
  }

  /// Moves vertices close to the cutoff onto it, so that the cut leaves no slivers.
  void snap(std::size_t fault) {
    const double reach = 0.3 * step_;
    snapToMeetingPoints(fault);
    for (Corner& corner : corners_) {
      if (corner.cuts != 0 || corner.fixed || (corner.on_x_edge && corner.on_y_edge))
        continue;
      const double distance = inside(fault, corner);
      if (std::abs(distance) >= reach)
        continue;
      const std::optional<Vector2> target = snapTarget(fault, corner);
      if (target) {
        corner.position = *target;
        corner.cuts |= 1u << fault;
      }
    }
  }

  /// Moves to each point where two cutoffs meet the nearest vertex that is on one of them.
  void snapToMeetingPoints(std::size_t fault) {
    const auto near = [&](const Corner& corner) {
      return corner.cuts != 0 && !corner.fixed && !corner.on_x_edge && !corner.on_y_edge &&
             std::abs(inside(fault, corner)) < 0.3 * step_;
    };
    struct Move {
      double length;
      std::size_t corner;
      Vector2 target;
    };
    std::vector<Move> moves;
    for (std::size_t v = 0; v < corners_.size(); ++v)
      if (near(corners_[v]))
        if (const auto target =
                meetingPoint(corners_[v].cuts, fault, corners_[v].position, 0.6 * step_))
          moves.push_back({(*target - corners_[v].position).norm(), v, *target});
    std::sort(moves.begin(), moves.end(), [](const Move& a, const Move& b) {
      return std::tie(a.length, a.corner) < std::tie(b.length, b.corner);
    });
    std::vector<Vector2> taken;
    for (const Move& move : moves) {
      if (std::any_of(taken.begin(), taken.end(),
                      [&](const Vector2& t) { return (t - move.target).norm() < step_; }))
        continue;
      taken.push_back(move.target);
      corners_[move.corner].position = move.target;
      corners_[move.corner].cuts |= 1u << fault;
    }
  }

  std::optional<Vector2> snapTarget(std::size_t fault, const Corner& corner) const {
    Vector2 direction = structure_.faults[fault].across;
    if (corner.on_x_edge || corner.on_y_edge)
      direction = corner.on_x_edge ? Vector2::UnitY() : Vector2::UnitX();
    const double limit = 0.45 * step_;
    const auto along = [&](double t) { return inside(fault, corner.position + t * direction); };
    if ((along(-limit) > 0.0) == (along(limit) > 0.0))
      return std::nullopt;
    return Vector2(corner.position + findRoot(along, -limit, limit) * direction);
  }

  /// The point on the cutoffs at \a fault and at one of \a cuts near \a start (Newton with
  /// difference quotients).
  std::optional<Vector2> meetingPoint(unsigned cuts, std::size_t fault, const Vector2& start,
                                      double reach) const {
    std::size_t other = 0;
    while ((cuts >> other & 1u) == 0)
      ++other;
    const auto value = [&](const Vector2& p) {
      return Vector2(inside(other, p), inside(fault, p));
    };
    const double d = 1e-4;
    Vector2 p = start;
    for (int k = 0; k < 30; ++k) {
      const Vector2 f = value(p);
      if (f.cwiseAbs().maxCoeff() < 1e-9)
        return (p - start).norm() <= reach ? std::optional<Vector2>(p) : std::nullopt;
      const Vector2 fx = (value(p + Vector2(d, 0.0)) - value(p - Vector2(d, 0.0))) / (2.0 * d);
      const Vector2 fy = (value(p + Vector2(0.0, d)) - value(p - Vector2(0.0, d))) / (2.0 * d);
      const double determinant = fx.x() * fy.y() - fy.x() * fx.y();
      if (determinant == 0.0)
        return std::nullopt;
      p -= Vector2(fy.y() * f.x() - fy.x() * f.y(), fx.x() * f.y() - fx.y() * f.x()) / determinant;
    }
    return std::nullopt;
  }

  /// Keeps what lies inside with respect to one fault.
  void clip(std::size_t fault) {
    std::vector<double> values(corners_.size());
    for (std::size_t v = 0; v < corners_.size(); ++v)
      values[v] = inside(fault, corners_[v]);
    std::map<std::pair<Index, Index>, Index> cut_edges;
    std::vector<Triangle> kept;
    for (const Triangle& triangle : triangles_) {
      std::vector<Index> polygon;
      bool any_inside = false;
      for (std::size_t e = 0; e < 3; ++e) {
        const Index a = triangle[e], b = triangle[(e + 1) % 3];
        const double va = values[static_cast<std::size_t>(a)],
                     vb = values[static_cast<std::size_t>(b)];
        any_inside |= va > 0.0;
        if (va >= 0.0)
          polygon.push_back(a);
        if ((va > 0.0 && vb < 0.0) || (va < 0.0 && vb > 0.0))
          polygon.push_back(cutEdge(fault, std::minmax(a, b), cut_edges));
      }
      if (!any_inside)
        continue;
      if (polygon.size() == 3)
        kept.push_back({polygon[0], polygon[1], polygon[2]});
      else if (polygon.size() == 4)
        splitQuad(polygon, kept);
    }
    triangles_ = std::move(kept);
  }

  Index cutEdge(std::size_t fault, std::pair<Index, Index> edge,
                std::map<std::pair<Index, Index>, Index>& cut_edges) {
    const auto [entry, is_new] = cut_edges.emplace(edge, static_cast<Index>(corners_.size()));
    if (!is_new)
      return entry->second;
    const Corner& a = corners_[static_cast<std::size_t>(edge.first)];
    const Corner& b = corners_[static_cast<std::size_t>(edge.second)];
    const auto along = [&](double t) {
      return inside(fault, a.position + t * (b.position - a.position));
    };
    Corner corner;
    corner.position = a.position + findRoot(along, 0.0, 1.0) * (b.position - a.position);
    corner.on_x_edge = a.on_x_edge && b.on_x_edge;
    corner.on_y_edge = a.on_y_edge && b.on_y_edge;
    corner.cuts = 1u << fault;
    const unsigned shared = a.cuts & b.cuts & ~corner.cuts;
    if (shared != 0)
      if (const auto meeting = meetingPoint(shared, fault, corner.position, step_)) {
        corner.position = *meeting;
        corner.cuts |= shared;
      }
    corners_.push_back(corner);
    return entry->second;
  }

  void splitQuad(const std::vector<Index>& quad, std::vector<Triangle>& out) const {
    const auto at = [&](std::size_t i) {
      return corners_[static_cast<std::size_t>(quad[i])].position;
    };
    const std::size_t first =
        (at(0) - at(2)).squaredNorm() <= (at(1) - at(3)).squaredNorm() ? 0 : 1;
    const auto q = [&](std::size_t i) { return quad[(first + i) % 4]; };
    out.push_back({q(0), q(1), q(2)});
    out.push_back({q(0), q(2), q(3)});
  }

  const Structure& structure_;
  const Sheet& sheet_;
  int cells_;
  double step_;
  std::vector<Corner> corners_;
  std::vector<Triangle> triangles_;
};

} // namespace

SheetMesh triangulateSheet(const Structure& structure, const Sheet& sheet, double resolution) {
  return SheetMesher(structure, sheet, resolution).run();
}

} // namespace synthetic

namespace {

struct ExactHash {
  std::size_t operator()(const Vector3& p) const {
    std::size_t seed = 0;
    for (const double value : {p.x(), p.y(), p.z()})
      seed = seed * 0x9e3779b97f4a7c15u + std::hash<double>()(value);
    return seed;
  }
};

/// Collects the sheets of one block; sheets joined round a tip have the same vertices there, bit by
/// bit.
class BlockMesh {
public:
  explicit BlockMesh(const SyntheticOptions& options)
      : options_(options) {}

  void add(const synthetic::Structure& structure, const synthetic::Sheet& sheet,
           const synthetic::SheetMesh& part) {
    std::vector<Index> index(part.positions.size(), -1);
    for (const Triangle& triangle : part.triangles) {
      Triangle joined{};
      for (std::size_t k = 0; k < 3; ++k) {
        Index& v = index[static_cast<std::size_t>(triangle[k])];
        if (v < 0)
          v = vertex(structure, sheet, part.positions[static_cast<std::size_t>(triangle[k])]);
        joined[k] = v;
      }
      if (options_.frame.mirrors())
        std::swap(joined[1], joined[2]);
      mesh_.triangles.push_back(joined);
    }
  }

  TriangleMesh& mesh() { return mesh_; }

private:
  Index vertex(const synthetic::Structure& structure, const synthetic::Sheet& sheet,
               const synthetic::Vector2& xy) {
    const Vector3 local = structure.lift(sheet, xy);
    const auto [entry, is_new] = known_.emplace(local, static_cast<Index>(mesh_.vertices.size()));
    if (is_new) {
      const synthetic::Vector2 slope = structure.heightGradient(sheet, xy);
      mesh_.vertices.push_back(options_.frame.toUser(local));
      mesh_.normals.push_back(
          options_.frame.normalToUser(Vector3(-slope.x(), -slope.y(), 1.0).normalized()));
      mesh_.piece.push_back(sheet.block);
    }
    return entry->second;
  }

  const SyntheticOptions& options_;
  TriangleMesh mesh_;
  std::unordered_map<Vector3, Index, ExactHash> known_;
};

} // namespace

std::vector<TriangleMesh> SyntheticModel::truthMeshes(double resolution) const {
  const double step = impl_->resolution(resolution);
  std::vector<TriangleMesh> meshes;
  for (Index block = 0; block < impl_->structure.blocks; ++block) {
    BlockMesh joined(impl_->options);
    for (const synthetic::Sheet& sheet : impl_->structure.sheets)
      if (sheet.block == block)
        joined.add(impl_->structure, sheet,
                   synthetic::triangulateSheet(impl_->structure, sheet, step));
    meshes.push_back(std::move(joined.mesh()));
  }
  return meshes;
}

} // namespace graben
