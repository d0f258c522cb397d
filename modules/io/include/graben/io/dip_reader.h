#pragma once

#include "graben/core/dip.h"
#include "graben/core/export.h"
#include "graben/io/pick_reader.h"

#include <cstddef>
#include <string>
#include <vector>

GRABEN_EXPORT_BEGIN
namespace graben {

/// The dip measurements of a file: places as the file has them, normals pointing up.
struct DipSet {
  std::vector<DipMeasurement> dips; ///< in file order
  std::string source;               ///< path of the file
  std::size_t rejected_rows = 0;    ///< rows after the last measurement that held none
  std::size_t no_data_rows = 0;     ///< rows dropped because a number was a null value
  std::vector<std::string> notes;   ///< sentences for the user: what was ignored, dropped or assumed
};

/// Reads dip measurements: a text table (.txt .csv .xyz .dat and any other name), one measurement per row.
///
/// Columns are x y z dip azimuth, or x y z strike dip, in any order if the header or a comment names them: dip or inclination;
/// azimuth, dip_direction, dip_dir, dip_azimuth; strike; x, y, z as readPicks knows them. Azimuth wins over strike. Without names
/// they are x y z dip azimuth, which a note says. Separators, comments, line ends and numbers are those of readPicks.
///
/// Angles are degrees: dip 0 to 90 down from the horizontal; azimuth (of the steepest descent) and strike (right-hand rule) clockwise
/// from north (y), 0 to 360 or -180 to 180.
/// z is taken as the file has it. Where it is a depth or a time, positive down, the angles mean the same - a bed that dips 30 towards 90
/// goes down towards the east - and so the normal points up all the same; who turns the picks' z turns the places' z in the same way.
///
/// Rows with a number that is null, not finite or missing from its field are dropped and counted in notes.
/// \throw IoError if the file cannot be read
/// \throw ParseError if the file is empty, holds no measurement, names columns but not all it needs, has an unreadable row among the
///   measurements or an angle out of its range; names file and line
DipSet readDips(const std::string& path, const ReadOptions& options = {});

} // namespace graben
GRABEN_EXPORT_END
