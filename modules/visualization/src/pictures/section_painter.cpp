#include "graben/visualization/section_drawing.h"

#include "drawing/plot.h"

#include "graben/core/errors.h"
#include "graben/core/ticks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace graben {

namespace {

constexpr Color kHorizonLine{0.15, 0.15, 0.18};

/// Light colours in the order of layers, as on geological sections.
Color layerColor(Index layer) {
  constexpr std::array<Color, 9> kColors = {{{0.93, 0.90, 0.80},
                                             {0.98, 0.82, 0.47},
                                             {0.62, 0.79, 0.60},
                                             {0.55, 0.72, 0.85},
                                             {0.86, 0.63, 0.52},
                                             {0.77, 0.70, 0.85},
                                             {0.75, 0.82, 0.45},
                                             {0.90, 0.70, 0.75},
                                             {0.60, 0.76, 0.76}}};
  return kColors[static_cast<std::size_t>(std::max<Index>(layer, 0)) % kColors.size()];
}

class SectionPainter {
public:
  explicit SectionPainter(const SectionDrawing& drawing) : d_(drawing), canvas_(drawing.width, drawing.height), font_(std::max(10.0, drawing.height / 46.0)) {
    layOut();
  }

  void write(const std::string& stem, const PictureFormats& formats) {
    canvas_.clip(plot_.frame);
    for (const DrawnArea& area : d_.areas) {
      std::vector<std::vector<Place>> rings;
      for (const auto& ring : area.rings)
        rings.push_back(places(ring));
      canvas_.area(rings, layerColor(area.layer_number));
    }
    canvas_.dots(places(d_.dots), 0.12 * font_, {0.35, 0.37, 0.40});
    for (const DrawnLine& line : d_.lines)
      canvas_.line(places(line.points), line.is_fault ? Pen{kFault, 0.16 * font_} : Pen{kHorizonLine, 0.11 * font_});
    for (const double bend : d_.bends)
      canvas_.line({{place({bend, 0.0}).x(), plot_.frame.top}, {place({bend, 0.0}).x(), plot_.frame.bottom()}}, {kGrey, 1.0, 1.0, {6.0, 4.0}});
    canvas_.unclip();
    for (const DrawnLabel& label : d_.labels) {
      TextLook look;
      look.size = 0.8 * font_;
      look.across = 0.0;
      look.halo = true;
      canvas_.text(place(label.at) + Place(0.5 * font_, 0.0), label.text, look);
    }
    drawAxes(canvas_, plot_, {"distance along the section", "z"}, false);
    writeAround();
    legend();
    canvas_.write(stem, formats);
  }

private:
  void layOut() {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    const auto extend = [&](const Eigen::Vector2d& p) {
      low = std::min(low, p.y());
      high = std::max(high, p.y());
    };
    for (const DrawnArea& area : d_.areas)
      for (const auto& ring : area.rings)
        std::for_each(ring.begin(), ring.end(), extend);
    for (const DrawnLine& line : d_.lines)
      std::for_each(line.points.begin(), line.points.end(), extend);
    if (!std::isfinite(low) || !std::isfinite(high) || !(d_.length > 0.0))
      throw InvalidInputError("drawing a section", "nothing to draw meets it");
    Frame& frame = plot_.frame;
    frame = {6.5 * font_, 4.0 * font_, d_.width - 22.0 * font_, d_.height - 8.5 * font_};
    double range = std::max(high - low, 1e-6 * d_.length);
    if (d_.vertical_exaggeration > 0.0) {
      const double wanted = d_.length / frame.width * frame.height / d_.vertical_exaggeration;
      frame.width *= std::min(1.0, wanted / range); // the frame gets narrower where the section is too high for it
      range = std::max(range, wanted);
    }
    const double middle = 0.5 * (low + high);
    const double up = d_.z_positive == ZPositive::Down ? -1.0 : 1.0;
    plot_.right = d_.length;
    plot_.bottom = middle - 0.5 * up * range;
    plot_.top = middle + 0.5 * up * range;
    exaggeration_ = (d_.length / frame.width) / (range / frame.height);
  }

  Place place(const Eigen::Vector2d& p) const { return plot_.at(p.x(), p.y()); }
  std::vector<Place> places(const std::vector<Eigen::Vector2d>& points) const {
    std::vector<Place> result;
    for (const Eigen::Vector2d& p : points)
      result.push_back(place(p));
    return result;
  }

  void writeAround() {
    const std::string exaggeration = "vertical exaggeration " + tickText(exaggeration_, 0.1 * roundDown125(exaggeration_));
    TextLook look;
    look.size = 1.15 * font_;
    canvas_.text({plot_.frame.middle().x(), 1.3 * font_}, d_.title.empty() ? exaggeration : d_.title + "   (" + exaggeration + ")", look);
    look.size = 0.85 * font_;
    look.across = 0.0;
    canvas_.text({plot_.frame.left, 3.1 * font_}, d_.start, look);
    look.across = 1.0;
    canvas_.text({plot_.frame.right(), 3.1 * font_}, d_.end, look);
  }

  void legend() {
    std::map<Index, std::string> layers;
    for (const DrawnArea& area : d_.areas)
      layers.emplace(area.layer_number, area.layer);
    std::vector<LegendEntry> entries;
    for (const auto& [number, name] : layers) {
      const Color color = layerColor(number);
      entries.push_back({name, [color](Canvas& canvas, const Frame& frame) { canvas.box(frame, color); }});
    }
    const auto line = [&](const std::string& name, const Pen& pen) {
      entries.push_back({name, [pen](Canvas& canvas, const Frame& frame) {
                           canvas.line({{frame.left, frame.middle().y()}, {frame.right(), frame.middle().y()}}, pen);
                         }});
    };
    const auto any = [&](bool faults) { return std::any_of(d_.lines.begin(), d_.lines.end(), [&](const DrawnLine& l) { return l.is_fault == faults; }); };
    if (any(false))
      line("horizons", {kHorizonLine, 0.11 * font_});
    if (any(true))
      line("faults", {kFault, 0.16 * font_});
    if (!d_.dots.empty())
      entries.push_back({"picks", [this](Canvas& canvas, const Frame& frame) { canvas.dots({frame.middle()}, 0.12 * font_, {0.35, 0.37, 0.40}); }});
    drawLegend(canvas_, {plot_.frame.right() + font_, plot_.frame.top}, entries);
  }

  const SectionDrawing& d_;
  Canvas canvas_;
  double font_;
  Plot plot_;
  double exaggeration_ = 1.0;
};

} // namespace

void drawSection(const std::string& stem, const PictureFormats& formats, const SectionDrawing& drawing) { SectionPainter(drawing).write(stem, formats); }

} // namespace graben
