#include "graben/visualization/section.h"

#include "drawing/plot.h"

#include "graben/core/errors.h"
#include "graben/core/ticks.h"
#include "graben/mesh/bounds.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace graben {

namespace {

constexpr const char* kStage = "drawing a section";

/// Distance along the section and z.
using SectionPlace = Eigen::Vector2d;

/// Where points project to on a section.
class Projection {
public:
  explicit Projection(const SectionLine& line) : start_(line.a.head<2>()), along_((line.b - line.a).head<2>()), length_(along_.norm()) {
    along_ /= length_;
  }
  SectionPlace of(const Vector3& p) const { return {along_.dot(p.head<2>() - start_), p.z()}; }
  double aside(const Vector3& p) const {
    const Eigen::Vector2d d = p.head<2>() - start_;
    return along_.x() * d.y() - along_.y() * d.x();
  }
  double length() const { return length_; }

private:
  Eigen::Vector2d start_, along_;
  double length_;
};

/// What lies in the section.
struct Content {
  std::vector<SectionPlace> picks;
  std::map<Index, std::vector<SectionSegment>> pieces;
  std::vector<SectionSegment> truth, faults;
};

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;

  bool empty() const { return !(low <= high); }
  void extend(double z) {
    low = std::min(low, z);
    high = std::max(high, z);
  }
  void extend(const std::vector<SectionSegment>& segments) {
    for (const SectionSegment& s : segments)
      for (const SectionPlace& end : s.ends)
        extend(end.y());
  }
};

void append(std::vector<SectionSegment>& to, const std::vector<SectionSegment>& more) { to.insert(to.end(), more.begin(), more.end()); }

Content contentOf(const SectionScene& scene, const SectionLine& line, double band) {
  Content content;
  if (scene.mesh != nullptr)
    for (const SectionSegment& segment : cutMesh(*scene.mesh, line)) {
      const auto vertex = static_cast<std::size_t>(scene.mesh->triangles[static_cast<std::size_t>(segment.triangle)][0]);
      content.pieces[scene.mesh->piece.empty() ? -1 : scene.mesh->piece[vertex]].push_back(segment);
    }
  for (const TriangleMesh* truth : scene.truth)
    append(content.truth, cutMesh(*truth, line));
  for (const TriangleMesh* fault : scene.faults)
    append(content.faults, cutMesh(*fault, line));
  const Projection projection(line);
  if (scene.picks != nullptr)
    for (const Vector3& p : *scene.picks) {
      const SectionPlace place = projection.of(p);
      if (p.allFinite() && place.x() >= 0.0 && place.x() <= projection.length() && std::abs(projection.aside(p)) <= band)
        content.picks.push_back(place);
    }
  return content;
}

/// Faults reach far over and under a horizon, so they count only where there is nothing else.
Range heightsOf(const Content& content) {
  Range range;
  for (const SectionPlace& p : content.picks)
    range.extend(p.y());
  for (const auto& [piece, segments] : content.pieces)
    range.extend(segments);
  range.extend(content.truth);
  if (range.empty())
    range.extend(content.faults);
  return range;
}

/// \return the vertical exaggeration
double setHeights(Plot& plot, const Range& range, const SectionOptions& options) {
  const double length = plot.right - plot.left;
  double height = std::max(1.35 * (range.high - range.low), 1e-3 * length);
  const double pixels_per_unit = plot.frame.width / length;
  if (options.vertical_exaggeration > 0.0) {
    height = plot.frame.height / (pixels_per_unit * options.vertical_exaggeration);
  } else {
    const double most = plot.frame.height / (height * pixels_per_unit);
    height = plot.frame.height / (pixels_per_unit * (most >= 1.0 ? roundDown125(most) : most));
  }
  const double middle = 0.5 * (range.low + range.high);
  plot.bottom = middle - 0.5 * height;
  plot.top = middle + 0.5 * height;
  if (options.units.z_positive == ZPositive::Down)
    std::swap(plot.bottom, plot.top);
  return plot.frame.height / (height * pixels_per_unit);
}

class SectionDrawing {
public:
  SectionDrawing(const SectionScene& scene, const SectionLine& line, const SectionOptions& options)
    : canvas_(options.width, options.height), scene_(scene), options_(options), projection_(line) {
    plot_.frame = {112.0, 48.0, options.width - 112.0 - 170.0, options.height - 48.0 - 64.0};
    plot_.right = projection_.length();
  }

  void draw(const std::string& stem, const Content& content) {
    const Range range = heightsOf(content);
    if (range.empty())
      throw InvalidInputError(kStage, "nothing meets the section");
    const double exaggeration = setHeights(plot_, range, options_);
    drawAxes(canvas_, plot_, {"distance along the section [" + options_.units.xy + "]", options_.units.heightTitle()}, true);
    canvas_.clip(plot_.frame);
    dots(content.picks);
    lines(content.faults, {kFault, 2.5});
    for (const auto& [piece, segments] : content.pieces)
      lines(segments, {darker(pieceColor(piece)), 3.0});
    lines(content.truth, {kDark, 1.3, 1.0, {6.0, 5.0}});
    for (const ThrowLabel& mark : scene_.throws)
      drawThrow(mark);
    canvas_.unclip();
    drawTitle(canvas_, options_.title, plot_.frame.middle().x());
    drawMargin(content, exaggeration);
    canvas_.write(stem, options_.formats);
  }

private:
  static Color darker(Color c) {
    for (double& x : c)
      x *= 0.72;
    return c;
  }

  Place at(const SectionPlace& p) const { return plot_.at(p.x(), p.y()); }

  void dots(const std::vector<SectionPlace>& picks) {
    std::vector<Place> places;
    for (const SectionPlace& p : picks)
      places.push_back(at(p));
    canvas_.dots(places, 2.2, kGrey);
  }

  void lines(const std::vector<SectionSegment>& segments, const Pen& pen) {
    std::vector<std::vector<Place>> strokes;
    for (const SectionSegment& s : segments)
      strokes.push_back({at(s.ends[0]), at(s.ends[1])});
    canvas_.lines(strokes, pen);
  }

  /// The two cutoffs' heights, carried out to a bar beside the fault.
  void drawThrow(const ThrowLabel& mark) {
    const Place f = at(projection_.of(mark.footwall));
    const Place h = at(projection_.of(mark.hanging_wall));
    const double side = h.x() >= f.x() ? 1.0 : -1.0; // over the hanging wall
    const double bar = (side > 0.0 ? std::max(f.x(), h.x()) : std::min(f.x(), h.x())) + 46.0 * side;
    const Pen pale{kDark, 1.0, 0.8, {3.0, 3.0}};
    canvas_.line({f, {bar + 6.0 * side, f.y()}}, pale);
    canvas_.line({h, {bar + 6.0 * side, h.y()}}, pale);
    canvas_.line({{bar, f.y()}, {bar, h.y()}}, {kDark, 2.0});
    canvas_.dots({f, h}, 4.0, kDark);
    TextLook look{15.0};
    look.across = side > 0.0 ? 0.0 : 1.0;
    look.halo = look.bold = true;
    canvas_.text({bar + 10.0 * side, 0.5 * (f.y() + h.y())}, mark.text, look);
  }

  void drawMargin(const Content& content, double exaggeration) {
    const double left = plot_.frame.right() + 18.0;
    const auto stroke = [](const Pen& pen) {
      return [pen](Canvas& c, const Frame& f) { c.line({{f.left, f.middle().y()}, {f.right(), f.middle().y()}}, pen); };
    };
    std::vector<LegendEntry> entries;
    if (!content.picks.empty())
      entries.push_back({"picks", [](Canvas& c, const Frame& f) { c.dots({f.middle()}, 2.5, kGrey); }});
    for (const auto& [piece, segments] : content.pieces)
      if (entries.size() < 12)
        entries.push_back({piece < 0 ? "surface" : "piece " + std::to_string(piece + 1), stroke({darker(pieceColor(piece)), 3.0})});
    if (!content.faults.empty())
      entries.push_back({"fault", stroke({kFault, 2.5})});
    if (!content.truth.empty())
      entries.push_back({"truth", stroke({kDark, 1.3, 1.0, {6.0, 5.0}})});
    const double down = drawLegend(canvas_, {left, plot_.frame.top + 4.0}, entries);
    TextLook look{13.0};
    look.across = 0.0;
    canvas_.text({left, down + 16.0}, options_.units.exaggerationText(exaggeration), look);
  }

  Canvas canvas_;
  const SectionScene& scene_;
  const SectionOptions& options_;
  Projection projection_;
  Plot plot_;
};

} // namespace

void drawSection(const std::string& stem, const SectionScene& scene, const SectionLine& line, const SectionOptions& options) {
  if (!(options.vertical_exaggeration >= 0.0 && std::isfinite(options.vertical_exaggeration)))
    throw InvalidInputError(kStage, "the vertical exaggeration must be 0 or positive");
  const double length = (line.b - line.a).head<2>().norm();
  const double band = options.band > 0.0 ? options.band : 0.01 * length;
  cutMesh(TriangleMesh(), line); // refuses a line without direction
  SectionDrawing(scene, line, options).draw(stem, contentOf(scene, line, band));
}

} // namespace graben
