#include "graben/visualization/fault_diagrams.h"

#include "drawing/plot.h"

#include "graben/core/errors.h"
#include "graben/core/ticks.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace graben {

namespace {

constexpr Color kFootwall{0.10, 0.34, 0.60};
constexpr Color kHangingWall{0.80, 0.40, 0.05};
constexpr Color kBand{0.55, 0.70, 0.86};

void check(const FaultCurve& curve) {
  const std::size_t count = curve.along.size();
  const bool band = curve.throw_low.empty() && curve.throw_high.empty();
  if (count == 0 || curve.throw_.size() != count || curve.footwall.size() != count || curve.hanging_wall.size() != count ||
      (!band && (curve.throw_low.size() != count || curve.throw_high.size() != count)))
    throw InvalidInputError("drawing a fault's diagram", "it must have at least one place, and one value for each of them");
}

/// Places of the curve that follow each other without a gap: first, and one past the last.
std::vector<std::pair<std::size_t, std::size_t>> stretches(const FaultCurve& curve) {
  std::vector<std::pair<std::size_t, std::size_t>> found;
  for (std::size_t i = 0; i < curve.along.size(); ++i)
    if (i == 0 || (curve.gap > 0.0 && curve.along[i] - curve.along[i - 1] > curve.gap))
      found.emplace_back(i, i + 1);
    else
      ++found.back().second;
  return found;
}

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;

  void extend(const std::vector<double>& values) {
    for (const double v : values)
      if (std::isfinite(v)) {
        low = std::min(low, v);
        high = std::max(high, v);
      }
  }
  void widen(double share) {
    const double by = high > low ? share * (high - low) : std::max(1.0, 0.1 * std::abs(high));
    low -= by;
    high += by;
  }
};

Plot plotOf(const DiagramOptions& options, const Range& x, const Range& y) {
  Plot plot;
  plot.frame = {100.0, 48.0, options.width - 100.0 - 180.0, options.height - 48.0 - 64.0};
  plot.left = x.low;
  plot.right = x.high > x.low ? x.high : x.low + 1.0;
  plot.bottom = y.low;
  plot.top = y.high;
  return plot;
}

std::vector<Place> placesOf(const Plot& plot, const FaultCurve& curve, const std::vector<double>& values, std::pair<std::size_t, std::size_t> stretch) {
  std::vector<Place> places;
  for (std::size_t i = stretch.first; i < stretch.second; ++i)
    places.push_back(plot.at(curve.along[i], values[i]));
  return places;
}

void drawCurve(Canvas& canvas, const Plot& plot, const FaultCurve& curve, const std::vector<double>& values, const Pen& pen) {
  for (const auto& stretch : stretches(curve)) {
    const std::vector<Place> places = placesOf(plot, curve, values, stretch);
    canvas.line(places, pen);
    if (places.size() == 1)
      canvas.dots(places, pen.width, pen.color);
  }
}

void fillBetween(Canvas& canvas, const Plot& plot, const FaultCurve& curve, const std::vector<double>& low, const std::vector<double>& high, Color color) {
  for (const auto& stretch : stretches(curve)) {
    std::vector<Place> ring = placesOf(plot, curve, low, stretch);
    const std::vector<Place> back = placesOf(plot, curve, high, stretch);
    ring.insert(ring.end(), back.rbegin(), back.rend());
    ring.erase(std::remove_if(ring.begin(), ring.end(), [](const Place& p) { return !p.allFinite(); }), ring.end());
    canvas.area(ring, color, 0.6);
  }
}

auto stroke(const Pen& pen) {
  return [pen](Canvas& c, const Frame& f) { c.line({{f.left, f.middle().y()}, {f.right(), f.middle().y()}}, pen); };
}

std::string alongTitle(const DiagramOptions& options) { return "distance along strike [" + options.units.xy + "]"; }

} // namespace

void drawThrowProfile(const std::string& stem, const FaultCurve& curve, const DiagramOptions& options) {
  check(curve);
  Range x, y;
  x.extend(curve.along);
  for (const std::vector<double>* values : {&curve.throw_, &curve.throw_low, &curve.throw_high})
    y.extend(*values);
  y.extend({0.0});
  y.widen(0.06);
  Canvas canvas(options.width, options.height);
  const Plot plot = plotOf(options, x, y);
  drawAxes(canvas, plot, {alongTitle(options), "throw [" + options.units.z + "]"}, true);
  canvas.clip(plot.frame);
  canvas.line({plot.at(plot.left, 0.0), plot.at(plot.right, 0.0)}, {kDark, 1.0});
  const Pen pen{kFootwall, 2.5};
  if (!curve.throw_low.empty())
    fillBetween(canvas, plot, curve, curve.throw_low, curve.throw_high, kBand);
  drawCurve(canvas, plot, curve, curve.throw_, pen);
  const auto largest = static_cast<std::size_t>(
    std::max_element(curve.throw_.begin(), curve.throw_.end(), [](double a, double b) { return std::abs(a) < std::abs(b); }) - curve.throw_.begin());
  const Place top = plot.at(curve.along[largest], curve.throw_[largest]);
  canvas.dots({top}, 4.0, kFootwall);
  canvas.unclip();
  const Frame& f = plot.frame;
  TextLook look{14.0};
  look.halo = true;
  look.across = top.x() > f.right() - 60.0 ? 1.0 : top.x() < f.left + 60.0 ? 0.0 : 0.5;
  look.up = curve.throw_[largest] < 0.0 ? 1.0 : 0.0;
  canvas.text(top + Place(0.0, curve.throw_[largest] < 0.0 ? 10.0 : -10.0), tickText(curve.throw_[largest], 0.1) + " " + options.units.z, look);
  drawTitle(canvas, options.title, f.middle().x());
  std::vector<LegendEntry> entries{{"throw", stroke(pen)}};
  if (!curve.throw_low.empty())
    entries.push_back({"P10 to P90", [](Canvas& c, const Frame& at) { c.box(at, kBand, 0.6); }});
  drawLegend(canvas, {f.right() + 16.0, f.top + 4.0}, entries);
  canvas.write(stem, options.formats);
}

void drawAllanDiagram(const std::string& stem, const std::vector<FaultCurve>& horizons, const DiagramOptions& options) {
  if (horizons.empty())
    throw InvalidInputError("drawing a fault's diagram", "there is no horizon");
  Range x, y;
  for (const FaultCurve& curve : horizons) {
    check(curve);
    x.extend(curve.along);
    y.extend(curve.footwall);
    y.extend(curve.hanging_wall);
  }
  y.widen(0.1);
  if (options.units.z_positive == ZPositive::Down)
    std::swap(y.low, y.high);
  Canvas canvas(options.width, options.height);
  const Plot plot = plotOf(options, x, y);
  const Frame& f = plot.frame;
  drawAxes(canvas, plot, {alongTitle(options), options.units.heightTitle()}, true);
  canvas.clip(f);
  for (const FaultCurve& curve : horizons)
    fillBetween(canvas, plot, curve, curve.footwall, curve.hanging_wall, {0.87, 0.87, 0.85});
  for (const FaultCurve& curve : horizons) {
    drawCurve(canvas, plot, curve, curve.footwall, {kFootwall, 2.5});
    drawCurve(canvas, plot, curve, curve.hanging_wall, {kHangingWall, 2.5, 1.0, {9.0, 6.0}});
  }
  canvas.unclip();
  for (const FaultCurve& curve : horizons) {
    if (horizons.size() < 2)
      break;
    TextLook look{14.0, kFootwall};
    look.across = 0.0;
    look.halo = true;
    canvas.text(plot.at(curve.along.back(), curve.footwall.back()) + Place(6.0, 0.0), curve.name, look);
  }
  drawTitle(canvas, options.title, f.middle().x());
  drawLegend(canvas, {f.right() + 16.0, f.top + 4.0}, {{"footwall", stroke({kFootwall, 2.5})}, {"hanging wall", stroke({kHangingWall, 2.5, 1.0, {9.0, 6.0}})}});
  canvas.write(stem, options.formats);
}

} // namespace graben
