#include "stages/parameter_checks.h"

#include "graben/core/errors.h"
#include "graben/core/short_number.h"

#include <algorithm>
#include <string>
#include <utility>

namespace graben {

namespace {

constexpr double kMuchOfSurface = 0.1; // left out by the flip angle

std::string flipAngleOf(const ReconstructionReport& report) {
  return "the flip angle of " + shortNumber(report.used.flip_angle) + " degrees left out " + std::to_string(report.rejected_by_flip_angle) + " triangles";
}

} // namespace

void checkLengths(const ReconstructionOptions& options, const Bounds& picks) {
  const double longest = picks.diagonal();
  const std::pair<const char*, double> lengths[] = {{"voxel size", options.voxel_size}, {"rho", options.rho}, {"delta", options.delta}};
  for (const auto& [name, length] : lengths)
    if (length > longest)
      throw InvalidInputError("options", std::string("the ") + name + " of " + shortNumber(length) + " is longer than the whole cloud of picks, " +
                                             shortNumber(longest) +
                                             " from corner to corner; give it in the picks' units, or leave it out to have it estimated");
}

void refuseEmptySurface(const NoSurface& what) {
  const ReconstructionReport& report = what.report;
  const UsedParameters& used = report.used;
  const std::size_t aside = report.picks - std::min(report.picks, what.picks_left);
  std::string why;
  if (what.cut)
    why = "the faults cut it into pieces too small to tell; do they lie in the horizon, or are they in other units?";
  else if (report.rejected_by_flip_angle > 0)
    why = flipAngleOf(report) + "; give a larger --flip-angle, 60 is usual";
  else if (2 * aside > report.picks)
    why = std::to_string(aside) + " of " + std::to_string(report.picks) + " picks were set aside, " + std::to_string(what.at_faults) +
          " of them within the clearance of a fault; check the faults" + (what.at_faults > 0 ? ", or give a smaller --clearance" : " and their units");
  else if (used.rho + used.delta < what.spacing)
    why = "rho and delta, " + shortNumber(used.rho + used.delta) + " together, are shorter than the picks' mean distance of " + shortNumber(what.spacing) +
          "; give a larger --rho, or leave it out to have it estimated";
  else if (used.voxel_size > what.spacing)
    why = "voxels of " + shortNumber(used.voxel_size) + " are too large for picks " + shortNumber(what.spacing) + " apart; give a smaller --voxel-size";
  else
    why = "the picks may be too few, or in several sheets through each other";
  throw InvalidInputError("marching cubes", "the surface has no triangles: " + why);
}

std::string warnOfFlipAngle(const ReconstructionReport& report, std::size_t triangles) {
  const auto all = static_cast<double>(report.rejected_by_flip_angle + triangles);
  if (static_cast<double>(report.rejected_by_flip_angle) <= kMuchOfSurface * all)
    return {};
  return "T" + flipAngleOf(report).substr(1) + ", " + shortNumber(100.0 * static_cast<double>(report.rejected_by_flip_angle) / all) +
         " % of the surface; 60 degrees are usual.";
}

} // namespace graben
