#include "model_impl.h"

namespace graben {
namespace {

using synthetic::Sheet;
using synthetic::Structure;
using synthetic::SyntheticFault;
using synthetic::Vector2;

/// Follows the cutoff of one sheet at one fault.
class CutoffTracer {
public:
  CutoffTracer(const Structure& structure, const Sheet& sheet, std::size_t fault)
      : structure_(structure)
      , sheet_(sheet)
      , fault_(fault)
      , f_(structure.faults[fault]) {}

  /// The parts of the cutoff inside the area and on the right side of the other faults.
  std::vector<Points> trace(double step) const {
    std::vector<Points> lines;
    bool inside_before = false;
    double before = 0.0;
    const std::vector<double> samples = strikeSamples(step);
    for (std::size_t k = 0; k < samples.size(); ++k) {
      const double s = samples[k];
      const bool inside = validity(s) >= 0.0;
      if (inside && !inside_before) {
        lines.emplace_back();
        if (k > 0)
          lines.back().push_back(at(border(s, before)));
      }
      if (inside)
        lines.back().push_back(at(s));
      else if (inside_before)
        lines.back().push_back(at(border(before, s)));
      inside_before = inside;
      before = s;
    }
    return lines;
  }

private:
  std::vector<double> strikeSamples(double step) const {
    auto [first, last] = structure_.strikeRange(fault_);
    const double margin = 0.01 * structure_.size;
    first -= f_.tip_direction < 0 ? 0.0 : margin;
    last += f_.tip_direction > 0 ? 0.0 : margin;
    const int count = std::max(1, static_cast<int>(std::ceil((last - first) / step)));
    std::vector<double> samples;
    for (int k = 0; k < count; ++k)
      samples.push_back(first + (last - first) * k / count);
    samples.push_back(last);
    if (f_.tip_direction == 0)
      return samples;
    // The cutoffs close like a parabola at the tip.
    constexpr int kExtra = 8;
    for (int k = 1; k < kExtra; ++k) {
      const double distance = (last - first) / count * k * k / (kExtra * kExtra);
      samples.push_back(f_.tip.x() - f_.tip_direction * distance);
    }
    std::sort(samples.begin(), samples.end());
    return samples;
  }

  Vector2 mapPoint(double s) const {
    if (f_.tip_direction != 0 && s == f_.tip.x())
      return f_.toMap(f_.tip);
    return f_.toMap({s, structure_.cutoff(sheet_, fault_, s)});
  }

  double validity(double s) const {
    const Vector2 xy = mapPoint(s);
    const double in_area = 0.5 * structure_.size - std::max(std::abs(xy.x()), std::abs(xy.y()));
    return std::min(
        {in_area, structure_.inside(sheet_, xy, static_cast<int>(fault_)), -f_.beyondTip(s)});
  }

  /// The last valid s between a valid and an invalid one.
  double border(double valid, double invalid) const {
    for (int k = 0; k < 60; ++k) {
      const double middle = 0.5 * (valid + invalid);
      (validity(middle) >= 0.0 ? valid : invalid) = middle;
    }
    return valid;
  }

  Vector3 at(double s) const { return structure_.lift(sheet_, mapPoint(s)); }

  const Structure& structure_;
  const Sheet& sheet_;
  std::size_t fault_;
  const SyntheticFault& f_;
};

} // namespace

std::vector<TrueCutoffLine> SyntheticModel::cutoffLines(double resolution) const {
  const double step = impl_->resolution(resolution);
  const Structure& structure = impl_->structure;
  std::vector<TrueCutoffLine> lines;
  for (std::size_t i = 0; i < structure.faults.size(); ++i)
    for (const int side : {-1, 1})
      for (const Sheet& sheet : structure.sheets) {
        if (sheet.side[i] != side || !structure.bounds(sheet, i))
          continue;
        for (Points& points : CutoffTracer(structure, sheet, i).trace(step)) {
          for (Vector3& p : points)
            p = impl_->toUser(p);
          points.erase(std::unique(points.begin(), points.end()), points.end());
          lines.push_back({static_cast<Index>(i), side, sheet.block, std::move(points)});
        }
      }
  return lines;
}

} // namespace graben
