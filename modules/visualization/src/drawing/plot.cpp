#include "drawing/plot.h"

#include "graben/core/ticks.h"

#include <algorithm>
#include <cmath>

namespace graben {

namespace {

constexpr double kTick = 6.0; // pixels
constexpr double kQuarterTurn = 1.57079632679489661923;

double stepOf(const std::vector<double>& ticks) { return ticks.size() > 1 ? ticks[1] - ticks[0] : 0.0; }

} // namespace

void drawAxes(Canvas& canvas, const Plot& plot, const AxisTitles& titles, bool grid) {
  const Frame& f = plot.frame;
  const Pen pale{{0.88, 0.89, 0.90}, 1.0};
  const Pen ink{kDark, 1.2};
  const TextLook number{14.0};
  const std::vector<double> xs = niceTicks(std::min(plot.left, plot.right), std::max(plot.left, plot.right), std::max(2, static_cast<int>(f.width / 130.0)));
  const std::vector<double> ys = niceTicks(std::min(plot.bottom, plot.top), std::max(plot.bottom, plot.top), std::max(2, static_cast<int>(f.height / 70.0)));
  double widest = 0.0;
  for (const double x : xs) {
    const double at = plot.at(x, plot.bottom).x();
    if (grid)
      canvas.line({{at, f.top}, {at, f.bottom()}}, pale);
    canvas.lines({{{at, f.bottom()}, {at, f.bottom() - kTick}}, {{at, f.top}, {at, f.top + kTick}}}, ink);
    TextLook look = number;
    look.up = 1.0;
    canvas.text({at, f.bottom() + 8.0}, tickText(x, stepOf(xs)), look);
  }
  for (const double y : ys) {
    const double at = plot.at(plot.left, y).y();
    if (grid)
      canvas.line({{f.left, at}, {f.right(), at}}, pale);
    canvas.lines({{{f.left, at}, {f.left + kTick, at}}, {{f.right(), at}, {f.right() - kTick, at}}}, ink);
    TextLook look = number;
    look.across = 1.0;
    const std::string text = tickText(y, stepOf(ys));
    widest = std::max(widest, canvas.textSize(text, look).x());
    canvas.text({f.left - 8.0, at}, text, look);
  }
  canvas.line({{f.left, f.top}, {f.right(), f.top}, {f.right(), f.bottom()}, {f.left, f.bottom()}}, ink, true);
  TextLook title{15.0};
  title.up = 1.0;
  canvas.text({f.middle().x(), f.bottom() + 30.0}, titles.x, title);
  title.up = 0.0;
  title.turn = -kQuarterTurn;
  canvas.text({f.left - widest - 20.0, f.middle().y()}, titles.y, title);
}

void drawColorBar(Canvas& canvas, const Frame& f, const ColorBar& bar) {
  Pixels stripes;
  stripes.width = 1;
  stripes.height = 256;
  for (int i = 0; i < stripes.height; ++i) { // the top has the larger value, or the smaller one where z grows downward
    const Color& c = bar.scale.at(1.0 - i / 255.0);
    const auto byte = [](double v) { return static_cast<std::uint32_t>(v * 255.0 + 0.5); };
    stripes.values.push_back(byte(c[0]) << 16 | byte(c[1]) << 8 | byte(c[2]));
  }
  canvas.image(stripes, f);
  canvas.line({{f.left, f.top}, {f.right(), f.top}, {f.right(), f.bottom()}, {f.left, f.bottom()}}, {kDark, 1.0}, true);
  const std::vector<double> ticks = niceTicks(bar.low, bar.high, std::max(2, static_cast<int>(f.height / 50.0)));
  for (const double value : ticks) {
    const double share = (value - bar.low) / (bar.high - bar.low);
    const double at = bar.reversed ? f.top + share * f.height : f.bottom() - share * f.height;
    canvas.line({{f.right() - 5.0, at}, {f.right(), at}}, {kDark, 1.0});
    TextLook look{14.0};
    look.across = 0.0;
    canvas.text({f.right() + 6.0, at}, tickText(value, stepOf(ticks)), look);
  }
  TextLook title{15.0};
  title.across = 0.0;
  title.up = 0.0;
  canvas.text({f.left - 6.0, f.top - 10.0}, bar.title, title);
}

double drawLegend(Canvas& canvas, Place corner, const std::vector<LegendEntry>& entries) {
  constexpr double kRow = 24.0;
  for (const LegendEntry& entry : entries) {
    entry.sample(canvas, {corner.x(), corner.y(), 30.0, 14.0});
    TextLook look{14.0};
    look.across = 0.0;
    canvas.text({corner.x() + 38.0, corner.y() + 7.0}, entry.text, look);
    corner.y() += kRow;
  }
  return corner.y();
}

void drawTitle(Canvas& canvas, const std::string& title, double middle) {
  TextLook look{18.0};
  look.bold = true;
  canvas.text({middle, 24.0}, title, look);
}

} // namespace graben
