#pragma once

#include "graben/filters/wrong_side_picks.h"
#include "graben/synthetic/synthetic_model.h"

#include <memory>

namespace graben::test {

/// A synthetic horizon, its picks and its faults as an interpreter gives them.
struct SyntheticCase {
  explicit SyntheticCase(const SyntheticOptions& given)
      : options(given)
      , model(given)
      , points(model.picks().points)
      , grid(points) {
    std::vector<FaultSurface> surfaces;
    for (std::size_t f = 0; f < model.faultCount(); ++f)
      surfaces.push_back(FaultSurface::fromMesh("F" + std::to_string(f + 1), model.faultMesh(f)));
    const double reach = given.kind == SyntheticKind::Branch ? 100.0 : 0.0;
    faults = std::make_shared<FaultNetwork>(std::move(surfaces), reach);
  }

  /// True if a pick lies on another side of a given fault than its sheet does of the true one.
  bool isWrong(std::size_t pick, double band) const {
    if (faults->nearest(points[pick], band).fault < 0)
      return false;
    const Vector3 truth = model.pick(pick).truth;
    for (std::size_t f = 0; f < faults->size(); ++f) {
      const FaultPoint near = faults->nearest(f, points[pick], band);
      if (near.fault >= 0 && !near.at_border &&
          near.side != (model.faultOffset(f, truth) < 0.0 ? -1 : 1))
        return true;
    }
    return false;
  }

  SyntheticOptions options;
  SyntheticModel model;
  Points points;
  NeighborGrid grid;
  std::shared_ptr<FaultNetwork> faults;
};

/// How well the wrong picks of a case were found.
struct Finding {
  std::size_t wrong = 0, found = 0, falsely = 0, judged = 0;
};

inline Finding rate(const SyntheticCase& job, const WrongSideResult& result) {
  Finding finding;
  finding.judged = result.judged;
  for (std::size_t i = 0; i < job.points.size(); ++i) {
    const bool flagged = result.reasons[i] != PickReason::Good;
    const bool wrong = job.isWrong(i, result.used.band);
    finding.wrong += wrong;
    finding.found += wrong && flagged;
    finding.falsely += !wrong && flagged;
  }
  return finding;
}

} // namespace graben::test
