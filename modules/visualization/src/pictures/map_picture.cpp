#include "graben/visualization/map_picture.h"

#include "drawing/contour_labels.h"
#include "drawing/plot.h"
#include "drawing/raster.h"

#include "graben/core/errors.h"
#include "graben/core/ticks.h"
#include "graben/mesh/bounds.h"
#include "graben/visualization/contours.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace graben {

namespace {

constexpr const char* kStage = "drawing a map";
constexpr double kPercentile = 0.98; // of the picks' values: where colours end, so that strays do not wash out the rest

/// Values to be drawn in colours.
struct Values {
  const ColorScale* scale = nullptr;
  std::vector<double> of_vertex;
  double low = 0.0, high = 1.0;
  bool reversed = false; ///< the smallest has the last colour

  const Color& color(double value) const {
    const double share = (value - low) / (high - low);
    return scale->at(reversed ? 1.0 - share : share);
  }
};

void setRange(Values& values, double low, double high) {
  values.low = low;
  values.high = high > low ? high : low + std::max(1e-6, 1e-6 * std::abs(low));
}

void setRangeToUsed(const TriangleMesh& mesh, Values& values) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Triangle& t : mesh.triangles)
    for (const Index v : t) {
      const double value = values.of_vertex[static_cast<std::size_t>(v)];
      if (!std::isfinite(value))
        continue;
      low = std::min(low, value);
      high = std::max(high, value);
    }
  setRange(values, std::isfinite(low) ? low : 0.0, std::isfinite(high) ? high : 1.0);
}

Values chooseValues(const MapScene& scene, const MapOptions& options) {
  const TriangleMesh& mesh = *scene.mesh;
  Values values;
  switch (options.colors) {
  case MapColors::Piece:
    if (mesh.piece.empty())
      throw InvalidInputError(kStage, "the mesh has no pieces to colour by");
    break;
  case MapColors::Height:
    values.scale = &ColorScale::height();
    values.reversed = options.units.z_positive == ZPositive::Down;
    for (const Vector3& p : mesh.vertices)
      values.of_vertex.push_back(p.z());
    setRangeToUsed(mesh, values);
    break;
  case MapColors::Scalar: {
    const auto field = mesh.scalars.find(options.scalar);
    if (field == mesh.scalars.end())
      throw InvalidInputError(kStage, "the mesh has no scalar named '" + options.scalar + "' to colour by");
    values.scale = &ColorScale::deviation();
    values.of_vertex.assign(field->second.begin(), field->second.end());
    setRangeToUsed(mesh, values);
    values.low = std::min(values.low, 0.0);
    break;
  }
  case MapColors::Picks: {
    if (scene.picks == nullptr || scene.pick_values == nullptr || scene.pick_values->size() != scene.picks->size())
      throw InvalidInputError(kStage, "there must be one value per pick");
    values.scale = &ColorScale::signedValue();
    std::vector<double> sizes;
    for (const float v : *scene.pick_values)
      if (std::isfinite(v))
        sizes.push_back(std::abs(static_cast<double>(v)));
    double limit = 1.0;
    if (!sizes.empty()) {
      const auto at = sizes.begin() + static_cast<std::ptrdiff_t>(kPercentile * static_cast<double>(sizes.size() - 1));
      std::nth_element(sizes.begin(), at, sizes.end());
      limit = *at > 0.0 ? *at : 1.0;
    }
    setRange(values, -limit, limit);
    break;
  }
  }
  return values;
}

/// Light from the north-west, gentle, as colours have to be read.
double shade(const Vector3& normal, double exaggeration) {
  const Vector3 n = Vector3(exaggeration * normal.x(), exaggeration * normal.y(), std::abs(normal.z())).normalized();
  static const Vector3 light = Vector3(-1.0, 1.0, 1.6).normalized();
  return 0.80 + 0.24 * std::max(0.0, (normal.z() < 0.0 ? Vector3(-n.x(), -n.y(), n.z()) : n).dot(light));
}

class MapDrawing {
public:
  MapDrawing(const MapScene& scene, const MapOptions& options)
    : scene_(scene), options_(options), canvas_(options.width, options.height), values_(chooseValues(scene, options)) {
    validate(*scene.mesh, kStage, options.threads);
    Bounds box;
    for (const Triangle& t : scene.mesh->triangles)
      for (const Index v : t)
        box.extend(scene.mesh->vertices[static_cast<std::size_t>(v)]);
    if (box.empty())
      throw InvalidInputError(kStage, "there is nothing to draw");
    place(box);
  }

  void draw(const std::string& stem) {
    canvas_.clip(plot_.frame);
    drawSurface();
    drawPicks();
    if (options_.colors == MapColors::Height)
      drawContours();
    drawFaults();
    canvas_.unclip();
    const std::string unit = " [" + options_.units.xy + "]";
    drawAxes(canvas_, plot_, {"x" + unit, "y" + unit}, false);
    drawTitle(canvas_, options_.title, plot_.frame.middle().x());
    drawMargin();
    canvas_.write(stem, options_.formats);
  }

private:
  /// The map as large as it fits, with some room around the data.
  void place(const Bounds& box) {
    const Frame room{112.0, 48.0, options_.width - 112.0 - 190.0, options_.height - 48.0 - 64.0};
    Vector3 size = box.size();
    const double least = std::max(1e-3 * std::max(size.x(), size.y()), 1e-9);
    size = size.cwiseMax(least) * 1.06;
    const double scale = std::min(room.width / size.x(), room.height / size.y());
    Frame& f = plot_.frame;
    f.width = std::max(std::round(scale * size.x()), 120.0);
    f.height = std::max(std::round(scale * size.y()), 120.0);
    f.left = std::round(room.left + 0.5 * (room.width - f.width));
    f.top = room.top;
    pixel_ = 1.0 / scale;
    const Vector3 middle = 0.5 * (box.low + box.high);
    plot_.left = middle.x() - 0.5 * f.width * pixel_;
    plot_.right = middle.x() + 0.5 * f.width * pixel_;
    plot_.bottom = middle.y() - 0.5 * f.height * pixel_;
    plot_.top = middle.y() + 0.5 * f.height * pixel_;
    exaggeration_ = size.z() > 0.0 ? std::clamp(0.15 * std::max(size.x(), size.y()) / size.z(), 1.0, 50.0) : 1.0;
  }

  Place at(const Vector3& p) const { return plot_.at(p.x(), p.y()); }

  Color colorOf(std::size_t v) const {
    Color c{0.90, 0.90, 0.89};
    if (options_.colors == MapColors::Piece)
      c = pieceColor(scene_.mesh->piece[v]);
    else if (options_.colors != MapColors::Picks)
      c = values_.color(values_.of_vertex[v]);
    const double light = scene_.mesh->normals.empty() ? 1.0 : shade(scene_.mesh->normals[v], exaggeration_);
    for (double& x : c)
      x = std::min(1.0, x * light);
    return c;
  }

  void drawSurface() {
    const TriangleMesh& mesh = *scene_.mesh;
    const double up = options_.units.z_positive == ZPositive::Down ? -1.0 : 1.0;
    Raster raster(static_cast<int>(plot_.frame.width), static_cast<int>(plot_.frame.height));
    const auto triangle = [&](std::size_t i) {
      RasterTriangle t;
      for (std::size_t k = 0; k < 3; ++k) {
        const auto v = static_cast<std::size_t>(mesh.triangles[i][k]);
        const Place p = at(mesh.vertices[v]) - Place(plot_.frame.left, plot_.frame.top);
        t.corners[k] = {p.x(), p.y(), up * mesh.vertices[v].z()};
        t.colors[k] = colorOf(v);
      }
      return t;
    };
    raster.draw(mesh.triangles.size(), triangle, 1.0, options_.threads);
    canvas_.image(raster.pixels(), plot_.frame);
  }

  /// Many dots are drawn as an image, or an SVG could not be opened.
  void drawPicks() {
    if (scene_.picks == nullptr)
      return;
    const Points& picks = *scene_.picks;
    const double area = plot_.frame.width * plot_.frame.height;
    const double radius = std::clamp(0.45 * std::sqrt(area / static_cast<double>(std::max<std::size_t>(picks.size(), 1))), 0.7, 3.0);
    Raster raster(static_cast<int>(plot_.frame.width), static_cast<int>(plot_.frame.height));
    const auto half = [&](std::size_t i) {
      const std::size_t pick = i / 2;
      RasterTriangle t;
      const float value = scene_.pick_values == nullptr ? 0.0F : (*scene_.pick_values)[pick];
      const Place p = at(picks[pick]) - Place(plot_.frame.left, plot_.frame.top);
      const double z = std::isfinite(value) ? 0.0 : std::numeric_limits<double>::quiet_NaN();
      const double side = i % 2 == 0 ? 1.0 : -1.0;
      t.corners = {Vector3(p.x() - radius, p.y() - radius, z), Vector3(p.x() + radius, p.y() + radius, z),
                   Vector3(p.x() + side * radius, p.y() - side * radius, z)};
      const Color c = scene_.pick_values == nullptr ? kDark : values_.color(value);
      t.colors = {c, c, c};
      return t;
    };
    raster.draw(2 * picks.size(), half, 1.0, options_.threads);
    canvas_.image(raster.pixels(), plot_.frame);
  }

  void drawContours() {
    const double step = contourStep(values_.low, values_.high);
    std::vector<double> levels;
    for (double i = std::ceil(values_.low / step); i * step <= values_.high; i += 1.0)
      levels.push_back(i * step);
    ContourLabels labels(canvas_, plot_.frame);
    for (const MapFault& fault : scene_.faults)
      for (const Points& line : fault.cutoffs)
        for (const Vector3& p : line)
          labels.keepFree(at(p));
    std::vector<std::vector<Place>> thin, thick;
    for (const ContourLine& line : contourLines(*scene_.mesh, values_.of_vertex, levels)) {
      std::vector<Place> places = thinned(line.points);
      const bool major = std::lround(line.value / step) % 5 == 0;
      if (major)
        labels.want(places, tickText(line.value, 5.0 * step));
      (major ? thick : thin).push_back(std::move(places));
    }
    canvas_.lines(thin, {kDark, 0.7, 0.55});
    canvas_.lines(thick, {kDark, 1.5, 0.75});
    labels.draw();
  }

  /// Leaves out points less than half a pixel on.
  std::vector<Place> thinned(const Points& points) const {
    std::vector<Place> places;
    for (const Vector3& p : points) {
      const Place q = at(p);
      if (places.empty() || (q - places.back()).squaredNorm() > 0.25)
        places.push_back(q);
    }
    if (places.size() == 1)
      places.push_back(at(points.back()));
    return places;
  }

  std::vector<Place> ringOf(const Points& ring) const {
    std::vector<Place> places;
    for (const Vector3& p : ring)
      places.push_back(at(p));
    return places;
  }

  void drawFaults() {
    for (const MapFault& fault : scene_.faults) {
      for (const Points& ring : fault.gaps)
        canvas_.area(ringOf(ring), kWhite, 0.9);
      for (const Points& ring : fault.overlaps)
        canvas_.hatch(ringOf(ring), {kFault, 1.0, 0.8}, 5.0);
      std::vector<std::vector<Place>> lines;
      for (const Points& line : fault.cutoffs)
        lines.push_back(thinned(line));
      canvas_.lines(lines, {kFault, 2.0});
    }
    for (const MapFault& fault : scene_.faults)
      nameFault(fault);
  }

  /// Beside the middle of the longest cutoff.
  void nameFault(const MapFault& fault) {
    const Points* longest = nullptr;
    for (const Points& line : fault.cutoffs)
      if (line.size() > 1 && (longest == nullptr || line.size() > longest->size()))
        longest = &line;
    if (longest == nullptr)
      return;
    const std::size_t m = longest->size() / 2;
    const Place run = at((*longest)[std::min(longest->size() - 1, m + 1)]) - at((*longest)[m > 0 ? m - 1 : 0]);
    const Place aside = run.norm() > 0.0 ? Place(Place(-run.y(), run.x()) / run.norm()) : Place(1.0, 0.0);
    TextLook look{15.0, kFault};
    look.halo = look.bold = true;
    canvas_.text(at((*longest)[m]) + 22.0 * aside, fault.name, look);
  }

  void drawMargin() {
    const double left = plot_.frame.right() + 34.0;
    double down = plot_.frame.top;
    drawNorth({left + 10.0, down + 4.0});
    down += 88.0;
    if (values_.scale != nullptr) {
      const std::string title = options_.colors == MapColors::Height ? options_.units.heightTitle() : options_.values_title;
      const double height = std::min(360.0, 0.45 * plot_.frame.height);
      drawColorBar(canvas_, {left, down, 22.0, height}, {*values_.scale, values_.low, values_.high, values_.reversed, title});
      down += height + 24.0;
    }
    down = drawLegend(canvas_, {left, down}, legend());
    drawScaleBar(left, down + 14.0);
  }

  std::vector<LegendEntry> legend() const {
    std::vector<LegendEntry> entries;
    const auto ring = [](const Frame& f) { return std::vector<Place>{{f.left, f.top}, {f.right(), f.top}, {f.right(), f.bottom()}, {f.left, f.bottom()}}; };
    const auto has = [this](auto member) {
      return std::any_of(scene_.faults.begin(), scene_.faults.end(), [&](const MapFault& f) { return !(f.*member).empty(); });
    };
    if (options_.colors == MapColors::Height)
      entries.push_back({"every " + tickText(contourStep(values_.low, values_.high), contourStep(values_.low, values_.high)) + " " + options_.units.z,
                         [](Canvas& c, const Frame& f) { c.line({{f.left, f.middle().y()}, {f.right(), f.middle().y()}}, {kDark, 1.0, 0.7}); }});
    if (options_.colors == MapColors::Piece)
      for (Index piece = 0; piece <= std::min<Index>(7, *std::max_element(scene_.mesh->piece.begin(), scene_.mesh->piece.end())); ++piece)
        entries.push_back({"piece " + std::to_string(piece + 1), [piece](Canvas& c, const Frame& f) { c.box(f, pieceColor(piece)); }});
    if (has(&MapFault::cutoffs))
      entries.push_back({"cutoff", [](Canvas& c, const Frame& f) { c.line({{f.left, f.middle().y()}, {f.right(), f.middle().y()}}, {kFault, 2.0}); }});
    if (has(&MapFault::gaps))
      entries.push_back({"gap", [ring](Canvas& c, const Frame& f) { c.line(ring(f), {kFault, 1.5}, true); }});
    if (has(&MapFault::overlaps))
      entries.push_back({"overlap", [ring](Canvas& c, const Frame& f) {
                           c.hatch(ring(f), {kFault, 1.0, 0.8}, 5.0);
                           c.line(ring(f), {kFault, 1.5}, true);
                         }});
    return entries;
  }

  void drawScaleBar(double left, double top) {
    const double length = roundDown125(110.0 * pixel_);
    const double pixels = length / pixel_;
    canvas_.line({{left, top}, {left, top + 8.0}, {left + pixels, top + 8.0}, {left + pixels, top}}, {kDark, 1.5});
    TextLook look{14.0};
    look.up = 1.0;
    look.across = 0.0;
    canvas_.text({left, top + 16.0}, tickText(length, length) + " " + options_.units.xy, look);
  }

  void drawNorth(Place tip) {
    canvas_.area({tip, tip + Place(10.0, 30.0), tip + Place(0.0, 22.0), tip + Place(-10.0, 30.0)}, kDark);
    canvas_.text(tip + Place(0.0, 44.0), "N", {15.0});
  }

  const MapScene& scene_;
  const MapOptions& options_;
  Canvas canvas_;
  Values values_;
  Plot plot_;
  double pixel_ = 1.0; ///< its size in x, y units
  double exaggeration_ = 1.0;
};

} // namespace

std::string PictureUnits::heightTitle() const {
  const bool time = z == "ms" || z == "s" || z == "us";
  return std::string(time ? "time" : z_positive == ZPositive::Down ? "depth" : "elevation") + " [" + z + "]";
}

std::string PictureUnits::exaggerationText(double factor) const {
  char number[32];
  std::snprintf(number, sizeof number, "%.3g", factor);
  return z == xy ? std::string("vertical exaggeration ") + number : "1 " + z + " drawn as " + number + " " + xy;
}

void drawMap(const std::string& stem, const MapScene& scene, const MapOptions& options) {
  if (scene.mesh == nullptr)
    throw InvalidInputError(kStage, "there is nothing to draw");
  MapDrawing(scene, options).draw(stem);
}

} // namespace graben
