#include "support/model_diagrams.h"

#include "support/takeaways.h"

#include "graben/core/errors.h"
#include "graben/visualization/fault_diagrams.h"

#include <algorithm>
#include <limits>

namespace graben {

namespace {

using Plan = Eigen::Vector2d;

/// Distances along a fault that all horizons share: along the straight line that follows their cutoffs best.
class CommonStrike {
public:
  CommonStrike(const ModelResult& result, std::size_t fault) {
    for (const ModelHorizonResult& h : result.horizons) {
      const std::vector<ProfileRow>& rows = h.profiles[fault].rows;
      if (rows.empty())
        continue;
      const Plan way = rows.back().footwall.head<2>() - rows.front().footwall.head<2>();
      way_ += way.dot(way_) < 0.0 ? Plan(-way) : way;
    }
    way_.normalize();
    for (const ModelHorizonResult& h : result.horizons)
      for (const ProfileRow& row : h.profiles[fault].rows)
        start_ = std::min(start_, row.footwall.head<2>().dot(way_));
  }

  double of(const ProfileRow& row) const { return row.footwall.head<2>().dot(way_) - start_; }

private:
  Plan way_ = Plan::Zero();
  double start_ = std::numeric_limits<double>::infinity();
};

FaultCurve curveOf(const ModelHorizonResult& horizon, const FaultProfile& profile, const CommonStrike& strike) {
  std::vector<ProfileRow> rows = profile.rows;
  std::stable_sort(rows.begin(), rows.end(), [&](const ProfileRow& a, const ProfileRow& b) { return strike.of(a) < strike.of(b); });
  FaultCurve curve;
  curve.name = horizon.name;
  curve.gap = 1.5 * profile.interval;
  for (const ProfileRow& row : rows) {
    curve.along.push_back(strike.of(row));
    curve.throw_.push_back(row.throw_);
    curve.footwall.push_back(row.footwall.z());
    curve.hanging_wall.push_back(row.hanging_wall.z());
  }
  return curve;
}

} // namespace

void drawAllanDiagrams(const std::filesystem::path& dir, const ModelResult& result) {
  DiagramOptions o;
  o.units.z_positive = result.frame.z_positive;
  o.formats = {true, true, false};
  for (std::size_t f = 0; f < result.faults.size(); ++f) {
    const CommonStrike strike(result, f);
    std::vector<FaultCurve> curves;
    for (const ModelHorizonResult& h : result.horizons)
      if (!h.profiles[f].rows.empty())
        curves.push_back(curveOf(h, h.profiles[f], strike));
    if (curves.empty())
      continue;
    std::error_code error;
    std::filesystem::create_directories(dir, error);
    if (error)
      throw WriteError(dir.string(), "the folder cannot be made: " + error.message());
    o.title = "Allan diagram of " + result.faults[f].name;
    drawAllanDiagram((dir / fileOfFault("allan", f, result.faults[f].name)).string(), curves, o);
  }
}

} // namespace graben
