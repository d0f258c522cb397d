#pragma once

#include "graben/core/export.h"

#include <string>

GRABEN_EXPORT_BEGIN
namespace graben {

/// A number for a sentence, in four figures: "205.3", "1.2e+06".
std::string shortNumber(double value);

} // namespace graben
GRABEN_EXPORT_END
