#include "section_layout.h"
#include "ticks.h"

#include <cmath>
#include <cstdio>

namespace graben {

namespace {

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.2f", value);
  return text;
}

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text)
    result += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '"' ? "&quot;" : std::string(1, c);
  return result;
}

std::string hex(const Color& color) {
  char text[8];
  std::snprintf(text, sizeof(text), "#%02x%02x%02x", static_cast<unsigned>(std::lround(255 * color[0])), static_cast<unsigned>(std::lround(255 * color[1])),
                static_cast<unsigned>(std::lround(255 * color[2])));
  return text;
}

class SvgWriter {
public:
  explicit SvgWriter(const SectionDrawing& drawing) : d_(drawing), l_(layOut(drawing)) {}

  std::string write() {
    out_ = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + std::to_string(d_.width) + "\" height=\"" +
           std::to_string(d_.height) + "\" viewBox=\"0 0 " + std::to_string(d_.width) + " " + std::to_string(d_.height) +
           "\" font-family=\"Helvetica, Arial, sans-serif\" font-size=\"" + number(l_.font) + "\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n";
    for (const DrawnArea& area : d_.areas)
      addArea(area);
    for (const Eigen::Vector2d& dot : d_.dots)
      addDot(dot);
    for (const DrawnLine& line : d_.lines)
      addLine(line);
    for (const double bend : d_.bends)
      addBend(bend);
    for (const DrawnLabel& label : d_.labels)
      addText(l_.pixel(label.at) + Eigen::Vector2d(0.5 * l_.font, 0.3 * l_.font), "start", label.text, 0.8);
    addFrame();
    addLegend();
    return out_ + "</svg>\n";
  }

private:
  void addArea(const DrawnArea& area) {
    out_ += "<path class=\"block\" fill=\"" + hex(layerColor(area.layer_number)) + "\" fill-rule=\"evenodd\" stroke=\"none\" d=\"";
    for (const auto& ring : area.rings) {
      out_ += "M";
      for (const Eigen::Vector2d& p : ring)
        appendPlace(p);
      out_ += "Z";
    }
    out_ += "\"><title>" + escaped(area.name) + "</title></path>\n";
  }

  void appendPlace(const Eigen::Vector2d& p) {
    const Eigen::Vector2d pixel = l_.pixel(p);
    out_ += number(pixel.x()) + "," + number(pixel.y()) + " ";
  }

  void addLine(const DrawnLine& line) {
    out_ += "<polyline fill=\"none\" stroke-linejoin=\"round\" stroke=\"" + hex(line.is_fault ? kFault : kHorizonLine) + "\" stroke-width=\"" +
            number((line.is_fault ? 0.16 : 0.11) * l_.font) + "\" points=\"";
    for (const Eigen::Vector2d& p : line.points)
      appendPlace(p);
    out_ += "\"><title>" + escaped(line.name) + "</title></polyline>\n";
  }

  void addDot(const Eigen::Vector2d& dot) {
    const Eigen::Vector2d p = l_.pixel(dot);
    out_ += "<circle cx=\"" + number(p.x()) + "\" cy=\"" + number(p.y()) + "\" r=\"" + number(0.1 * l_.font) + "\" fill=\"#595e66\"/>\n";
  }

  void addSegment(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const std::string& style) {
    out_ += "<line x1=\"" + number(a.x()) + "\" y1=\"" + number(a.y()) + "\" x2=\"" + number(b.x()) + "\" y2=\"" + number(b.y()) + "\" " + style + "/>\n";
  }

  void addBend(double s) {
    const double x = l_.left + s / l_.length * l_.width;
    addSegment({x, l_.top}, {x, l_.top + l_.height}, "stroke=\"#555\" stroke-dasharray=\"6,4\" stroke-width=\"1\"");
  }

  void addText(const Eigen::Vector2d& at, const std::string& anchor, const std::string& text, double size = 1.0) {
    out_ += "<text x=\"" + number(at.x()) + "\" y=\"" + number(at.y()) + "\" text-anchor=\"" + anchor + "\" font-size=\"" + number(size * l_.font) + "\">" +
            escaped(text) + "</text>\n";
  }

  void addFrame() {
    out_ += "<rect x=\"" + number(l_.left) + "\" y=\"" + number(l_.top) + "\" width=\"" + number(l_.width) + "\" height=\"" + number(l_.height) +
            "\" fill=\"none\" stroke=\"#222\" stroke-width=\"1\"/>\n";
    const double bottom = l_.top + l_.height;
    const std::vector<double> along = niceTicks(0.0, l_.length, 8);
    for (const double s : along) {
      const double x = l_.left + s / l_.length * l_.width;
      addSegment({x, bottom}, {x, bottom + 0.4 * l_.font}, "stroke=\"#222\"");
      addText({x, bottom + 1.5 * l_.font}, "middle", tickText(s, along.size() > 1 ? along[1] - along[0] : 0.0));
    }
    const std::vector<double> heights = niceTicks(l_.low, l_.high, 8);
    for (const double z : heights) {
      const double y = l_.top + (l_.high - z) / (l_.high - l_.low) * l_.height;
      addSegment({l_.left - 0.4 * l_.font, y}, {l_.left, y}, "stroke=\"#222\"");
      addText({l_.left - 0.6 * l_.font, y + 0.35 * l_.font}, "end",
              tickText(z == 0.0 ? 0.0 : l_.z_factor * z, heights.size() > 1 ? heights[1] - heights[0] : 0.0));
    }
    addText({l_.left + 0.5 * l_.width, bottom + 3.2 * l_.font}, "middle", "distance along the section");
    out_ += "<text transform=\"translate(" + number(1.2 * l_.font) + "," + number(l_.top + 0.5 * l_.height);
    out_ += ") rotate(-90)\" text-anchor=\"middle\">z</text>\n";
    const std::string exaggeration = "vertical exaggeration " + tickText(l_.exaggeration, 0.1 * roundDown125(l_.exaggeration));
    addText({l_.left + 0.5 * l_.width, 1.6 * l_.font}, "middle", d_.title.empty() ? exaggeration : d_.title + "   (" + exaggeration + ")", 1.15);
    addText({l_.left, 3.4 * l_.font}, "start", d_.start, 0.85);
    addText({l_.left + l_.width, 3.4 * l_.font}, "end", d_.end, 0.85);
  }

  void addLegend() {
    const double x = l_.left + l_.width + l_.font;
    double y = l_.top;
    for (const LegendEntry& entry : legendOf(d_)) {
      if (entry.is_line)
        addSegment({x, y + 0.5 * l_.font}, {x + 1.6 * l_.font, y + 0.5 * l_.font},
                   "stroke=\"" + hex(entry.color) + "\" stroke-width=\"" + number(0.16 * l_.font) + "\"");
      else
        out_ += "<rect x=\"" + number(x) + "\" y=\"" + number(y) + "\" width=\"" + number(1.6 * l_.font) + "\" height=\"" + number(l_.font) + "\" fill=\"" +
                hex(entry.color) + "\" stroke=\"#555\" stroke-width=\"0.5\"/>\n";
      addText({x + 2.1 * l_.font, y + 0.9 * l_.font}, "start", entry.text, 0.9);
      y += 1.6 * l_.font;
    }
  }

  const SectionDrawing& d_;
  SectionLayout l_;
  std::string out_;
};

} // namespace

std::string sectionSvg(const SectionDrawing& drawing) { return SvgWriter(drawing).write(); }

} // namespace graben
