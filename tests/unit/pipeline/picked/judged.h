#pragma once

#include "graben/analysis/evaluation.h"
#include "unit/pipeline/small_model.h"

#include <gtest/gtest.h>

#include <regex>

namespace graben::test {

/// A reconstruction of picks that lie as an interpreter's do, and what it is against the truth.
struct Judged {
  ReconstructionResult result;
  SurfaceEvaluation against;
  double true_throw = 0.0; ///< mean of the first fault

  double throwError() const { return result.report.faults.front().throw_.mean - true_throw; }
  /// True if a warning has words that match.
  bool says(const std::string& words) const {
    const std::regex wanted(words, std::regex::icase);
    const std::vector<std::string>& warnings = result.report.warnings;
    return std::any_of(warnings.begin(), warnings.end(), [&](const std::string& w) { return std::regex_search(w, wanted); });
  }
};

/// Mean height over the length of lines on the map.
inline double meanHeight(const std::vector<TrueCutoffLine>& lines, Index fault, int side) {
  double sum = 0.0, length = 0.0;
  for (const TrueCutoffLine& line : lines)
    for (std::size_t k = 1; line.fault == fault && line.side == side && k < line.points.size(); ++k) {
      const double step = (line.points[k] - line.points[k - 1]).head<2>().norm();
      sum += 0.5 * step * (line.points[k].z() + line.points[k - 1].z());
      length += step;
    }
  return length > 0.0 ? sum / length : 0.0;
}

/// \param[in] reach how far from a pick the truth has to be there; not in half as wide a margin at the edge of the area
inline Judged judge(const SyntheticModel& model, Points picks, double reach, const ReconstructionOptions& options = {}) {
  Judged judged;
  EvaluationInput input;
  input.picks = picks;
  judged.result = HorizonReconstruction(options).reconstruct(std::move(picks), faultsOf(model));
  input.mesh = judged.result.mesh;
  for (const TriangleMesh& block : model.truthMeshes())
    append(input.truth, block);
  std::vector<FaultSurface> faults;
  for (std::size_t f = 0; f < model.faultCount(); ++f)
    faults.push_back(FaultSurface::fromMesh("fault", model.faultMesh(f)));
  input.faults = FaultNetwork(std::move(faults));
  const std::vector<TrueCutoffLine> cutoffs = model.cutoffLines();
  for (const TrueCutoffLine& line : cutoffs)
    input.cutoffs.push_back(line.points);
  EvaluationOptions evaluate;
  evaluate.voxel_size = judged.result.report.used.voxel_size;
  evaluate.pick_reach = reach;
  evaluate.margin = 0.5 * reach;
  evaluate.samples = 20000;
  judged.against = evaluateSurface(input, evaluate);
  judged.true_throw = meanHeight(cutoffs, 0, -1) - meanHeight(cutoffs, 0, 1);
  return judged;
}

struct Limits {
  double away = 1.0, near = 2.0; ///< RMS from the surface to the truth and back, in metres
  double throw_error = 6.0;
};

/// Both ways within the limits, sealed, as many pieces as there are blocks, the throw right.
inline void expectRight(const Judged& judged, const SyntheticModel& model, const Limits& limits) {
  const SurfaceEvaluation& e = judged.against;
  const OneWayDistances& missing = *e.truth->from_truth_at_picks;
  EXPECT_LT(e.truth->to_truth.far.rms, limits.away);
  EXPECT_LT(missing.far.rms, 1.5 * limits.away);
  EXPECT_EQ(e.topology.components, model.blockCount());
  EXPECT_TRUE(e.ok());
  if (model.faultCount() == 0)
    return;
  EXPECT_LT(e.truth->to_truth.near.rms, limits.near);
  EXPECT_LT(missing.near.rms, 1.5 * limits.near);
  EXPECT_GT(e.seal_by_truth->all.share, 0.95);
  EXPECT_LT(std::abs(judged.throwError()), limits.throw_error) << judged.result.report.faults.front().throw_.mean << " of " << judged.true_throw;
}

} // namespace graben::test
