#pragma once

#include "graben/core/export.h"
#include "graben/io/fault_reader.h"
#include "graben/io/pick_set.h"

#include <string>
#include <vector>

GRABEN_EXPORT_BEGIN
namespace graben {

/// What is known of the input beside the files.
struct InputCheckOptions {
  double z_scale = 1.0;     ///< what z is multiplied by for distances; other than 1: units of z are the user's business
  bool z_way_given = false; ///< the user says which way z grows
};

/// What files of one job say together.
struct InputFindings {
  std::string contradiction;         ///< why picks and faults cannot be of one frame, and what to do; empty: they can
  std::vector<std::string> warnings; ///< units of z that are probably not those of x and y
  std::vector<std::string> notes;    ///< what was assumed
};

/// Compares the picks of a horizon and the faults that are to cut it.
///
/// Where no fault comes near the picks as written, but all would with z turned over, with feet turned into metres, seconds into
/// milliseconds or back, or with x and y exchanged, that is a contradiction; so are places in degrees, and single picks a thousand times as far away as
/// all others spread, coordinates beyond 1e15, and faults that consist of the picks. Where z spans far less or more than
/// x and y can (km, seconds), or the files name units that differ, that is a warning with a hint at the scale of z.
/// z of faults counts as turned over where picks and faults say opposite ways.
/// \param[in,out] picks where they do not say which way z grows, and all faults that say so agree and fit only as they are written, z_positive is
/// taken from them, which a note says
/// Cost is linear. Thread-safe.
InputFindings checkInput(PickSet& picks, const std::vector<FaultInput>& faults, const InputCheckOptions& options = {});

} // namespace graben
GRABEN_EXPORT_END
