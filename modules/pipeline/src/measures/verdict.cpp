#include "measures/verdict.h"

#include "graben/core/short_number.h"

#include <algorithm>

namespace graben {

namespace {

constexpr double kMostNoise = 3.0;       // standard deviations of the picks
constexpr double kLeastNoise = 0.02;     // voxels: picks exacter than this are missed by the triangles' size
constexpr double kLeastCoverage = 0.95;
constexpr double kLeastSeal = 0.95;
constexpr std::size_t kFewestOnFault = 20; // vertices: where a fault only touches the surface there is no throw

std::string percent(double share) { return shortNumber(100.0 * share) + " %"; }

void judgeMisfit(ReconstructionReport& r) {
  const double noise = r.layout.along_lines ? r.layout.noise : r.sampling.sigma;
  if (r.all_picks.count == 0 || r.all_picks.rms <= kMostNoise * std::max(noise, kLeastNoise * r.used.voxel_size))
    return;
  r.warnings.push_back("The picks lie " + shortNumber(r.all_picks.rms) + " (root mean square) from the surface, but only " + shortNumber(noise) +
                       " about smooth surfaces of their own; the field residual shows where they lie off it.");
}

void judgeCoverage(ReconstructionReport& r) {
  if (r.coverage < kLeastCoverage)
    r.warnings.push_back("Only " + percent(r.coverage) + " of the picks have the surface near them; a larger --rho bridges wider gaps between picks.");
}

void judgeSeal(ReconstructionReport& r) {
  for (std::size_t f = 0; f < r.seal.faults.size() && f < r.faults.size(); ++f)
    if (r.faults[f].cut_vertices > 0 && r.seal.faults[f].vertices > 0 && r.seal.faults[f].share < kLeastSeal)
      r.warnings.push_back("Only " + percent(r.seal.faults[f].share) + " of the surface's border at fault " + r.faults[f].name + " is sealed to it.");
  for (const ShadowAtFault& shadow : r.shadows.found)
    if (shadow.places == 0)
      r.warnings.push_back("The surface ends before fault " + shadow.fault + " on its " + (shadow.hanging_wall ? "hanging wall" : "footwall") +
                           ", where picks stop " + shortNumber(shadow.width) + " before it; --fault-reach " + shortNumber(1.5 * shadow.widest) +
                           " carries it on to the fault.");
}

void judgeThrow(ReconstructionReport& r) {
  for (const FaultReport& f : r.faults)
    if (f.cut_vertices >= kFewestOnFault && f.throw_.samples == 0)
      r.warnings.push_back("Fault " + f.name + " cuts the surface, but nowhere are both its cutoffs near picks: no throw was read off it.");
}

} // namespace

void judgeResult(ReconstructionReport& report) {
  judgeMisfit(report);
  judgeCoverage(report);
  judgeSeal(report);
  judgeThrow(report);
}

} // namespace graben
