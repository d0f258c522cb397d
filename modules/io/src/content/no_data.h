#pragma once

#include "graben/io/pick_set.h"

#include <vector>

namespace graben {

/// What counts as no data beside what always does.
struct NullRules {
  bool terminators = false;     ///< also drop rows 999 999 999, the line ends of IRAP/RMS text
  std::vector<double> values{}; ///< z values that the user or the file's header calls null
  unsigned threads = 0;
  bool recognise = true; ///< also what looks like a null
};

/// Drops points with a coordinate that is not finite or a null z, and says which and how many in notes.
///
/// Null is a z of 1e29 or more, one that \a rules name, and, where it lies far outside all other z, a customary code (999.25, -9999,
/// 9999900, 32767, 0 and others) or a value that is repeated exactly very many times. Rows with such a code for both x and y are dropped too.
void dropNoData(PickSet& picks, const NullRules& rules);

/// The z values that are null among those of \a points: those that the rules name and those that lie as dropNoData wants it.
std::vector<double> nullsOf(const Points& points, const NullRules& rules);

/// True for what isNullValue tells and for one of \a nulls.
bool isNullAmong(const std::vector<double>& nulls, double z);

/// True for values that are no coordinate whatever the others are: 1e29 and beyond, not finite.
bool isNullValue(double value);

/// True for values that many programs write for "no data"; honest numbers may be among them.
bool isNullCode(double value);

/// True for 999 999 999, which ends a line in IRAP/RMS text.
bool isTerminator(const Vector3& point);

} // namespace graben
