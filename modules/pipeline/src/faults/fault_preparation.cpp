#include "faults/fault_preparation.h"

#include "faults/step_at_fault.h"

#include "graben/core/errors.h"
#include "graben/core/short_number.h"
#include "graben/core/threads.h"
#include "graben/faults/extension.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace graben {

namespace {

constexpr std::size_t kStrayPicks = 8; // beyond an end at the data's edge; inside the data there are several times as many

/// Whether an end of a fault lies at the data's edge: picks on its near side, but hardly any farther along strike. Such an end is no tip.
class EndsAtDataEdge {
public:
  EndsAtDataEdge(const NeighborGrid& picks, const FaultPreparation& options) : picks_(picks), options_(options) {}

  bool operator()(const Points& end, const Points& outward) const {
    Neighbor nearest;
    nearest.squared_distance = options_.extension * options_.extension;
    Vector3 place;
    Vector3 way;
    for (std::size_t i = 0; i + 1 < end.size(); ++i) {
      const Vector3 run = end[i + 1] - end[i];
      const double steps = std::clamp(std::ceil(run.norm() / options_.pick_distance), 1.0, 1e4);
      for (double s = 0.0; s <= steps; ++s) {
        const Vector3 p = end[i] + s / steps * run;
        const Neighbor found = picks_.nearestOne(p, std::sqrt(nearest.squared_distance));
        if (found.index < 0)
          continue;
        nearest = found;
        place = p;
        way = outward[i];
      }
    }
    return nearest.index >= 0 && !dataGoesOn(place, way);
  }

private:
  bool dataGoesOn(const Vector3& place, const Vector3& outward) const {
    std::vector<Neighbor> around;
    picks_.within(place, options_.extension, around);
    const auto beyond = std::count_if(around.begin(), around.end(), [&](const Neighbor& n) {
      return (picks_.points()[static_cast<std::size_t>(n.index)] - place).dot(outward) > options_.pick_distance;
    });
    return beyond > static_cast<std::ptrdiff_t>(kStrayPicks);
  }

  const NeighborGrid& picks_;
  const FaultPreparation& options_;
};

/// Continues a fault to the horizon where the picks have a step there, and says how far.
class FaultExtension {
public:
  FaultExtension(std::string name, const NeighborGrid& picks, const FaultPreparation& options, std::vector<std::string>& notes)
    : name_(std::move(name)), picks_(picks), options_(options), notes_(notes) {}

  FaultSurface operator()(const FaultSurface& fault) {
    if (options_.extension == 0.0)
      return fault;
    const auto where = [this](const Points& border, const Points& outward) { return whereExtended(border, outward); };
    FaultSurface result = extendedAlongDip(fault, options_.extension, where);
    const EndsAtDataEdge at_edge(picks_, options_);
    int ends = 0;
    const auto goes_on = [&](const Points& end, const Points& outward) {
      const bool on = at_edge(end, outward);
      ends += on;
      return on;
    };
    result = extendedAlongStrike(result, options_.along_strike, goes_on);
    sayWhat(ends);
    return result;
  }

  /// To the horizon, along dip or strike; 0 if it need not be or was not.
  double length() const { return length_; }

private:
  /// Not where the horizon passes whole, unless a step is near along the border.
  std::vector<bool> whereExtended(const Points& border, const Points& outward) {
    std::vector<bool> wanted(border.size(), true);
    if (options_.extend_always)
      return wanted;
    std::vector<double> along{0.0};
    for (std::size_t i = 0; i + 1 < border.size(); ++i)
      along.push_back(along.back() + (border[i + 1] - border[i]).norm());
    const double step = std::max(along.back() / kMostLooks, options_.pick_distance);
    std::vector<std::pair<double, StepVerdict>> verdicts;
    for (std::size_t i = 0; i + 1 < border.size(); ++i) {
      const Vector3 run = border[i + 1] - border[i];
      const double parts = std::ceil(run.norm() / step);
      for (double k = 0.0; k < parts; k += 1.0) {
        const double t = (k + 0.5) / parts;
        const BorderPlace place{border[i] + t * run, ((1.0 - t) * outward[i] + t * outward[i + 1]).normalized(), run.normalized(), options_.extension,
                                options_.pick_distance};
        const StepAtFault found = stepAtFault(picks_, place);
        verdicts.emplace_back(along[i] + t * run.norm(), found.verdict);
        if (found.verdict == StepVerdict::Step)
          extended_ = std::max(extended_, found.length);
        if (found.verdict == StepVerdict::Whole)
          short_of_ = std::max(short_of_, found.length);
      }
    }
    for (std::size_t i = 0; i < border.size(); ++i)
      wanted[i] = isWanted(along[i], verdicts);
    return wanted;
  }

  bool isWanted(double at, const std::vector<std::pair<double, StepVerdict>>& verdicts) const {
    StepVerdict nearest = StepVerdict::Unknown;
    double away = std::numeric_limits<double>::infinity();
    for (const auto& [place, verdict] : verdicts) {
      const double distance = std::abs(place - at);
      if (verdict == StepVerdict::Step && distance <= kBeside * options_.extension)
        return true;
      if (verdict != StepVerdict::Unknown && distance < away) {
        away = distance;
        nearest = verdict;
      }
    }
    return nearest != StepVerdict::Whole || away > kBeside * options_.extension;
  }

  void sayWhat(int ends) {
    length_ = std::max(extended_, ends > 0 ? options_.along_strike : 0.0);
    if (extended_ > 0.0)
      notes_.push_back("Fault " + name_ + " was extended along its dip by up to " + shortNumber(extended_) + " to reach the horizon.");
    else if (short_of_ > 0.0)
      notes_.push_back("Fault " + name_ + " ends up to " + shortNumber(short_of_) +
                       " short of the horizon, where the picks show no step: it was not extended. --extend-faults D extends all faults by D.");
    if (ends > 0)
      notes_.push_back("Fault " + name_ + " was extended along its strike by " + shortNumber(options_.along_strike) + " at " +
                       (ends == 1 ? "one end" : "both ends") + ", where the picks end too.");
  }

  static constexpr double kMostLooks = 200.0; // along a border
  static constexpr double kBeside = 1.0;      // extensions along strike that a step tells of

  const std::string name_;
  const NeighborGrid& picks_;
  const FaultPreparation& options_;
  std::vector<std::string>& notes_;
  double extended_ = 0.0;
  double short_of_ = 0.0;
  double length_ = 0.0;
};

} // namespace

std::vector<FaultSurface> prepareFaults(const std::vector<FaultInput>& faults, const LocalFrame& frame, const NeighborGrid& picks,
                                        const FaultPreparation& options, std::vector<std::string>& warnings,
                                        std::vector<std::string>& notes, std::vector<double>* extended) {
  std::vector<FaultSurface> surfaces;
  for (const FaultInput& fault : faults) {
    if (fault.z_positive != ZPositive::Unknown && fault.z_positive != frame.z_positive)
      warnings.push_back("Fault " + fault.name + " has its z the other way up than the picks; it was turned over.");
    LoftedFaults lofted = faultSurfaces(fault, frame, options.loft);
    warnings.insert(warnings.end(), lofted.warnings.begin(), lofted.warnings.end());
    notes.insert(notes.end(), lofted.notes.begin(), lofted.notes.end());
    for (const FaultSurface& surface : lofted.faults) {
      FaultExtension extension(surface.name, picks, options, notes);
      surfaces.push_back(extension(surface));
      if (extended != nullptr)
        extended->push_back(extension.length());
    }
  }
  return surfaces;
}

TriangleMesh toUserFrame(TriangleMesh local, const LocalFrame& frame, unsigned threads) {
  constexpr std::size_t kGrain = 1 << 14;
  parallelFor(local.vertices.size(), kGrain, threads, [&](std::size_t v) { local.vertices[v] = frame.toUser(local.vertices[v]); });
  parallelFor(local.normals.size(), kGrain, threads, [&](std::size_t v) { local.normals[v] = frame.normalToUser(local.normals[v]); });
  if (frame.mirrors())
    for (Triangle& t : local.triangles)
      std::swap(t[1], t[2]);
  return local;
}

FaultSurface toUserFrame(const FaultSurface& local, const LocalFrame& frame) {
  return {local.name, toUserFrame(local.mesh, frame)};
}

} // namespace graben
