#pragma once

#include "support/options.h"

#include "graben/pipeline/horizon_reconstruction.h"

#include <filesystem>

namespace graben {

/// Names of the units of a horizon's coordinates, for what people read.
struct UnitNames {
  std::string xy = "m";
  std::string z = "m";
};

/// Declares --xy-unit and --z-unit.
void declareUnitOptions(OptionParser& parser);

/// What the options say, else what the picks' file does, else metres (z: milliseconds where it is scaled).
/// \param[in] of_picks units as the file of the picks names them, empty where it does not
/// \throw UsageError if a unit's name has characters that a header cannot hold
UnitNames unitNames(const OptionValues& values, const UnitNames& of_picks = {"", ""});

/// throw_N_FAULT.csv: a row for each place where throw, heave and dip slip are read off, with units.
void writeThrows(const std::filesystem::path& dir, const ReconstructionResult& result, const UnitNames& units);

/// Writes, for each fault that cuts the horizon, its throw along strike: profile_N_NAME.csv.
void writeProfiles(const std::filesystem::path& dir, const ReconstructionResult& result, const UnitNames& units);

/// Writes the fault polygons: fault_polygons.csv, .geojson, .shp with .shx and .dbf, and for each fault gap_N_NAME.pol and overlap_N_NAME.pol. Nothing
/// where there are none.
void writePolygons(const std::filesystem::path& dir, const ReconstructionResult& result);

/// A fault's file: WHAT_N_NAME without extension; N counts from 1.
std::string fileOfFault(const std::string& what, std::size_t fault, const std::string& name);

} // namespace graben
