#pragma once

#include "graben/pipeline/reconstruction_report.h"

#include <nlohmann/json.hpp>

namespace graben {

/// The report as it is written, with a fixed order of keys.
nlohmann::ordered_json reportTree(const ReconstructionReport& report, bool with_timings);

} // namespace graben
