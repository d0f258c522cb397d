#pragma once

#include "graben/core/export.h"
#include "graben/pipeline/reconstruction_report.h"

#include <string>
#include <vector>

GRABEN_EXPORT_BEGIN
namespace graben {

/// A demand on one figure of the report: `rms<5`.
struct Requirement {
  enum class Comparison { Below, AtMost, Above, AtLeast, Equal };

  std::string figure; ///< a key of the report's "figures", or the way to any other number in it: topology.border_loops
  Comparison comparison = Comparison::Below;
  double limit = 0.0; ///< in the figure's unit
};

/// Reads demands parted by commas, each a figure, one of < <= > >= = and a number: "rms<5,seal<0.1,bridges=0,coverage>0.98".
/// \throw InvalidInputError if a demand cannot be read or the report has no such figure (the message lists those it has)
std::vector<Requirement> parseRequirements(const std::string& text);

/// The demands that a report does not meet, each as a sentence that names the figure, its value and the limit; empty if the surface is good enough.
/// A figure that was not measured (null in the report) meets nothing. Thread-safe. \throw InvalidInputError as parseRequirements
std::vector<std::string> unmetRequirements(const std::vector<Requirement>& requirements, const ReconstructionReport& report);

} // namespace graben
GRABEN_EXPORT_END
