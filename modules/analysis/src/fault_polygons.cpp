#include "graben/analysis/fault_polygons.h"

#include "usual_distance.h"

#include "graben/mesh/bounds.h"

#include <boost/geometry.hpp>
#include <boost/geometry/geometries/multi_polygon.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace graben {

namespace {

namespace bg = boost::geometry;
using Place = bg::model::d2::point_xy<double>;
using Area = bg::model::polygon<Place, false>; // counter-clockwise, closed
using Areas = bg::model::multi_polygon<Area>;


/// The two cutoffs at one place along strike.
struct Rung {
  Vector3 footwall, hanging_wall;
};

/// A stretch of a fault that is normal, or reverse, throughout.
struct Stretch {
  bool overlap = false;
  std::vector<Rung> rungs;
};

std::vector<Stretch> stretchesOf(const std::vector<ThrowSample>& samples) {
  std::vector<Stretch> stretches;
  const double gap = kGapInSamples * usualDistance(samples);
  bool open = false;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const ThrowSample& s = samples[i];
    const Rung rung{s.footwall, s.hanging_wall};
    if (open && s.along - samples[i - 1].along > gap)
      open = false;
    if (open && s.heave != 0.0 && (s.heave < 0.0) != stretches.back().overlap) {
      const ThrowSample& before = samples[i - 1];
      if (before.heave == 0.0 && stretches.back().rungs.size() == 1) {
        stretches.back().overlap = s.heave < 0.0; // began at a tip
      } else {
        const double t = before.heave / (before.heave - s.heave);
        const Rung turn{before.footwall + t * (s.footwall - before.footwall), before.hanging_wall + t * (s.hanging_wall - before.hanging_wall)};
        stretches.back().rungs.push_back(turn);
        stretches.push_back({s.heave < 0.0, {turn}});
      }
    } else if (!open) {
      stretches.push_back({s.heave < 0.0, {}});
      open = true;
    }
    stretches.back().rungs.push_back(rung);
  }
  return stretches;
}

Place placeOf(const Vector3& p, const Vector3& origin) { return {p.x() - origin.x(), p.y() - origin.y()}; }

/// The union of the areas between each two neighbouring rungs: valid however the cutoffs wind.
Areas unionOfSteps(const Stretch& stretch, const Vector3& origin, std::size_t begin, std::size_t end) {
  if (end - begin == 1) {
    const Rung& a = stretch.rungs[begin];
    const Rung& b = stretch.rungs[begin + 1];
    Areas both;
    for (const auto& corners : {std::array{a.footwall, b.footwall, a.hanging_wall}, std::array{b.footwall, b.hanging_wall, a.hanging_wall}}) {
      Area triangle;
      for (const Vector3& p : corners)
        bg::append(triangle.outer(), placeOf(p, origin));
      bg::correct(triangle);
      if (!(bg::area(triangle) > 0.0))
        continue;
      Areas sum;
      bg::union_(both, triangle, sum);
      both = std::move(sum);
    }
    return both;
  }
  const std::size_t middle = begin + (end - begin) / 2;
  Areas sum;
  bg::union_(unionOfSteps(stretch, origin, begin, middle), unionOfSteps(stretch, origin, middle, end), sum);
  return sum;
}

Areas areaOf(const Stretch& stretch, const Vector3& origin) {
  if (stretch.rungs.size() < 2)
    return {};
  Area ring;
  const auto add = [&](const Vector3& p) {
    const Place place = placeOf(p, origin);
    if (ring.outer().empty() || place.x() != ring.outer().back().x() || place.y() != ring.outer().back().y())
      ring.outer().push_back(place);
  };
  for (const Rung& rung : stretch.rungs)
    add(rung.footwall);
  for (auto rung = stretch.rungs.rbegin(); rung != stretch.rungs.rend(); ++rung)
    add(rung->hanging_wall);
  bg::correct(ring);
  if (bg::is_valid(ring))
    return {ring};
  return unionOfSteps(stretch, origin, 0, stretch.rungs.size() - 1);
}

/// Heights along the two cutoffs of a stretch, for points of a ring that lie on them or, where polygons were parted, near them.
class Heights {
public:
  explicit Heights(const Stretch& stretch) {
    for (const bool footwall : {true, false})
      for (std::size_t i = 0; i + 1 < stretch.rungs.size(); ++i) {
        const Rung& a = stretch.rungs[i];
        const Rung& b = stretch.rungs[i + 1];
        edges_.push_back(footwall ? std::array{a.footwall, b.footwall} : std::array{a.hanging_wall, b.hanging_wall});
      }
  }

  double at(const Vector3& p) const {
    double best = std::numeric_limits<double>::infinity();
    double z = 0.0;
    for (const auto& [a, b] : edges_) {
      const Vector3 run = b - a;
      const double squared = run.head<2>().squaredNorm();
      const double t = squared > 0.0 ? std::clamp((p - a).head<2>().dot(run.head<2>()) / squared, 0.0, 1.0) : 0.0;
      const Vector3 foot = a + t * run;
      const double distance = (foot - p).head<2>().squaredNorm();
      if (distance < best) {
        best = distance;
        z = foot.z();
      }
    }
    return z;
  }

private:
  std::vector<std::array<Vector3, 2>> edges_;
};

FaultPolygon toPolygon(const Area& area, const Heights& heights, const Vector3& origin) {
  FaultPolygon polygon;
  polygon.area = bg::area(area);
  for (std::size_t i = 0; i + 1 < area.outer().size(); ++i) {
    Vector3 p(area.outer()[i].x() + origin.x(), area.outer()[i].y() + origin.y(), 0.0);
    p.z() = heights.at(p);
    polygon.ring.push_back(p);
  }
  return polygon;
}

/// What the faults before have taken.
class Taken {
public:
  Areas leave(Areas areas) const {
    if (areas.empty())
      return areas;
    const auto box = bg::return_envelope<bg::model::box<Place>>(areas);
    for (const auto& [other_box, other] : taken_) {
      if (!bg::intersects(box, other_box))
        continue;
      Areas rest;
      bg::difference(areas, other, rest);
      areas = std::move(rest);
    }
    return areas;
  }

  void add(const Areas& areas) {
    for (const Area& area : areas)
      taken_.emplace_back(bg::return_envelope<bg::model::box<Place>>(area), area);
  }

private:
  std::vector<std::pair<bg::model::box<Place>, Area>> taken_;
};

Vector3 originOf(const std::vector<std::vector<ThrowSample>>& throws) {
  for (const std::vector<ThrowSample>& samples : throws)
    if (!samples.empty())
      return samples.front().footwall;
  return Vector3::Zero();
}

} // namespace

std::vector<FaultPolygon> faultPolygons(const std::vector<std::vector<ThrowSample>>& throws, const FaultPolygonOptions& options) {
  const Vector3 origin = originOf(throws);
  std::vector<FaultPolygon> polygons;
  Taken taken;
  for (std::size_t f = 0; f < throws.size(); ++f) {
    for (const Stretch& stretch : stretchesOf(throws[f])) {
      const Areas areas = taken.leave(areaOf(stretch, origin));
      const Heights heights(stretch);
      for (const Area& area : areas) {
        if (!(bg::area(area) > options.least_area))
          continue;
        polygons.push_back(toPolygon(area, heights, origin));
        polygons.back().fault = static_cast<Index>(f);
        polygons.back().overlap = stretch.overlap;
      }
      taken.add(areas);
    }
  }
  return polygons;
}

} // namespace graben
