#pragma once

#include "graben/io/pick_set.h"

namespace graben {

/// Drops points with a coordinate that is not finite or a null z, and says how many in notes.
/// \param[in] terminators also drop rows 999 999 999, the line ends of IRAP/RMS text
void dropNoData(PickSet& picks, bool terminators, unsigned threads);

/// True for values no coordinate has: 1e30 and beyond, not finite, 999.25 with either sign, -99999.
bool isNullValue(double value);

/// True for 999 999 999, which ends a line in IRAP/RMS text.
bool isTerminator(const Vector3& point);

} // namespace graben
