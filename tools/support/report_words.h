#pragma once

#include "support/takeaways.h"

#include "graben/visualization/html_report.h"

namespace graben {

/// What a report says in words; the first part is the summary.
std::vector<ReportSection> reportSections(const ReconstructionResult& result, const UnitNames& units, const std::string& options);

} // namespace graben
