#pragma once

#include "support/evaluation_input.h"

#include <limits>
#include <string>
#include <vector>

namespace graben {

/// One figure of a surface beside the limit it should keep.
struct Figure {
  std::string key;
  std::string text; ///< for people
  double value = 0.0;
  double limit = std::numeric_limits<double>::infinity(); ///< infinite: none
  std::string unit;   ///< of value and limit; empty: a count or share
  bool exact = false; ///< value must be the limit, not just below it

  bool ok() const { return exact ? value == limit : value <= limit; }
};

/// The figures in the order of the project's table of limits; only those that were measured.
/// \param[in] sigma noise of the picks in x, y units, the unit of distances to the truth; 0:
/// unknown, then these have no limit
std::vector<Figure> figuresOf(const SurfaceEvaluation& evaluation, double sigma);

/// Everything as a table for people.
std::string evaluationText(const EvaluationFiles& files, const SurfaceEvaluation& evaluation,
                           double sigma);

/// Everything as JSON, with a fixed order of keys; of bridging and flipped triangles the places of
/// the first 100.
std::string evaluationJson(const OptionValues& values, const EvaluationFiles& files,
                           const SurfaceEvaluation& evaluation, double sigma);

} // namespace graben
