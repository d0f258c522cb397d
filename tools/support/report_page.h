#pragma once

#include "support/takeaways.h"

#include "graben/visualization/html_report.h"

namespace graben {

/// Writes report.html: an interactive view of the horizon, the pictures given, and in words what went in, what came of it and how good it is.
/// \param[in] options what the user asked for, in words
void writeReportPage(const std::filesystem::path& dir, const ReconstructionResult& result, const UnitNames& units, const std::string& options,
                     std::vector<ReportPicture> pictures);

} // namespace graben
