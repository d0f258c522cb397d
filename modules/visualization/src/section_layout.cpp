#include "section_layout.h"

#include "graben/core/errors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace graben {

SectionLayout layOut(const SectionDrawing& drawing) {
  SectionLayout layout;
  layout.z_factor = drawing.z_positive == ZPositive::Down ? -1.0 : 1.0;
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  const auto extend = [&](const Eigen::Vector2d& p) {
    low = std::min(low, layout.z_factor * p.y());
    high = std::max(high, layout.z_factor * p.y());
  };
  for (const DrawnArea& area : drawing.areas)
    for (const auto& ring : area.rings)
      std::for_each(ring.begin(), ring.end(), extend);
  for (const DrawnLine& line : drawing.lines)
    std::for_each(line.points.begin(), line.points.end(), extend);
  if (!std::isfinite(low) || !std::isfinite(high) || !(drawing.length > 0.0))
    throw InvalidInputError("drawing a section", "nothing to draw meets it");
  layout.font = std::max(10.0, drawing.height / 46.0);
  layout.left = 6.5 * layout.font;
  layout.top = 4.0 * layout.font;
  layout.width = drawing.width - layout.left - 15.0 * layout.font;
  layout.height = drawing.height - layout.top - 4.5 * layout.font;
  layout.length = drawing.length;
  const double middle = 0.5 * (low + high);
  double range = std::max(high - low, 1e-6 * drawing.length);
  if (drawing.vertical_exaggeration > 0.0) {
    const double wanted = layout.length / layout.width * layout.height / drawing.vertical_exaggeration;
    if (wanted < range) { // the frame gets narrower
      layout.width *= wanted / range;
    } else {
      range = wanted;
    }
  }
  layout.low = middle - 0.5 * range;
  layout.high = middle + 0.5 * range;
  layout.exaggeration = (layout.length / layout.width) / (range / layout.height);
  return layout;
}

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

std::vector<LegendEntry> legendOf(const SectionDrawing& drawing) {
  std::map<Index, std::string> layers;
  for (const DrawnArea& area : drawing.areas)
    layers.emplace(area.layer_number, area.layer);
  std::vector<LegendEntry> entries;
  for (const auto& [number, name] : layers)
    entries.push_back({name, layerColor(number), false});
  bool horizons = false, faults = false;
  for (const DrawnLine& line : drawing.lines)
    (line.is_fault ? faults : horizons) = true;
  if (horizons)
    entries.push_back({"horizons", kHorizonLine, true});
  if (faults)
    entries.push_back({"faults", kFault, true});
  if (!drawing.dots.empty())
    entries.push_back({"picks", {0.35, 0.37, 0.40}, true});
  return entries;
}

} // namespace graben
