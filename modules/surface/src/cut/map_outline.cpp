#include "graben/surface/map_outline.h"

#include "sheet_clip.h"

#include "graben/core/threads.h"

#include <boost/geometry.hpp>
#include <boost/geometry/geometries/multi_point.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>

#include <cmath>
#include <limits>

namespace graben {

namespace {

namespace bg = boost::geometry;
using MapPoint = bg::model::d2::point_xy<double>;

double squaredToEdge(const Vector3& p, const Vector3& a, const Vector3& b) {
  const Eigen::Vector2d run = (b - a).head<2>();
  const Eigen::Vector2d from = (p - a).head<2>();
  const double length = run.squaredNorm();
  const double t = length > 0.0 ? std::min(1.0, std::max(0.0, from.dot(run) / length)) : 0.0;
  return (from - t * run).squaredNorm();
}

/// Whether a ray from the place along +x passes the edge.
bool passes(const Vector3& p, const Vector3& a, const Vector3& b) {
  if ((a.y() > p.y()) == (b.y() > p.y()))
    return false;
  return p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
}

} // namespace

MapOutline::MapOutline(const std::vector<Points>& rings) {
  for (const Points& ring : rings) {
    Points kept;
    for (const Vector3& p : ring)
      if (p.head<2>().allFinite())
        kept.emplace_back(p.x(), p.y(), 0.0);
    if (kept.size() > 1 && kept.front() == kept.back())
      kept.pop_back();
    if (kept.size() >= 3)
      rings_.push_back(std::move(kept));
  }
}

MapOutline MapOutline::hullOf(const Points& points) {
  bg::model::multi_point<MapPoint> places;
  for (const Vector3& p : points)
    if (p.allFinite())
      bg::append(places, MapPoint(p.x(), p.y()));
  bg::model::polygon<MapPoint> hull;
  bg::convex_hull(places, hull);
  Points ring;
  for (const MapPoint& p : hull.outer())
    ring.emplace_back(p.x(), p.y(), 0.0);
  return bg::area(hull) > 0.0 ? MapOutline({ring}) : MapOutline();
}

double MapOutline::beyond(const Vector3& place) const {
  bool inside = false;
  double squared = std::numeric_limits<double>::infinity();
  for (const Points& ring : rings_)
    for (std::size_t i = 0, last = ring.size() - 1; i < ring.size(); last = i++) {
      squared = std::min(squared, squaredToEdge(place, ring[last], ring[i]));
      inside = inside != passes(place, ring[last], ring[i]);
    }
  return inside ? -std::sqrt(squared) : std::sqrt(squared);
}

void clipToOutline(SheetMesh& sheets, const MapOutline& outline, double overhang, unsigned threads) {
  if (outline.empty())
    return;
  const TriangleMesh& mesh = sheets.mesh;
  std::vector<double> beyond(mesh.vertices.size());
  parallelFor(beyond.size(), 1024, threads, [&](std::size_t v) { beyond[v] = outline.beyond(mesh.vertices[v]); });
  std::vector<std::size_t> all(mesh.triangles.size());
  for (std::size_t t = 0; t < all.size(); ++t)
    all[t] = t;
  detail::clipSheets(sheets, all, {[&](Index v) { return beyond[static_cast<std::size_t>(v)]; }, overhang});
}

} // namespace graben
