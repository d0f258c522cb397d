#pragma once

#include "graben/core/export.h"

#include <string>
#include <vector>

GRABEN_EXPORT_BEGIN
namespace graben {

/// The largest 1, 2 or 5 times a power of ten that is not above \a value (positive).
double roundDown125(double value);

/// Multiples of a round step inside [low, high]; at most \a count + 1 of them.
std::vector<double> niceTicks(double low, double high, int count);

/// A number without needless digits: 1500, 0.25, 6782000.
std::string tickText(double value, double step);

} // namespace graben
GRABEN_EXPORT_END
