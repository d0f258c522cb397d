#pragma once

#include "graben/core/export.h"

#include <string>
#include <vector>

GRABEN_EXPORT_BEGIN
namespace graben {

/// Steps of a reconstruction to leave out, to see what each one does. None is left out by default; the surface is worse without any of them.
struct SkippedSteps {
  bool neighbors = false;  ///< normals and their orientation from the nearest picks, also across faults
  bool sides = false;      ///< one distance field for all sides: the surface goes through a throw as a curtain before it is cut
  bool trim = false;       ///< the surface ends in whole cells at the edge of the data
  bool cut = false;        ///< the surface is not cut along the faults
  bool wrong_side = false; ///< picks on the wrong side of a fault, or smeared along it, take part
  bool shadows = false;    ///< the surface is not carried on across strips beside faults that hold no picks, but for the usual reach
  bool zone_fit = false;   ///< no fit to the quadrics near the faults, of which one round beside them precedes the local fit
  bool local_fit = false;  ///< no fit to local polynomials after it; the fit to the quadrics then is made in full
  bool snap = false;       ///< vertices of marching cubes all stay on their own lattice edges
  bool tidy = false;       ///< folds and triangles that reach over a fault stay as the fit left them
};

/// A step's name for options and reports, and its place in SkippedSteps.
struct SkippableStep {
  const char* name;
  bool SkippedSteps::*flag;
};

/// All steps that can be left out, in the order of SkippedSteps.
const std::vector<SkippableStep>& skippableSteps();

/// Marks the step with this name. \return false if there is none
bool skipStep(SkippedSteps& skip, const std::string& name);

/// The names of the steps left out.
std::vector<std::string> names(const SkippedSteps& skip);

} // namespace graben
GRABEN_EXPORT_END
