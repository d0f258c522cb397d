#pragma once

#include "graben/core/export.h"
#include "graben/core/types.h"
#include "graben/faults/fault_surface.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

GRABEN_EXPORT_BEGIN
namespace graben {

/// Points with what is known of them, for writePcd.
struct LabelledPoints {
  Points points;
  Points normals = {};                   ///< one per point, or empty
  std::vector<Index> piece = {};         ///< one per point, -1 for none; or empty
  std::vector<std::uint8_t> reason = {}; ///< why the point was set aside, 0: it was not; one per point, or empty
};

/// What a PCD has beside x y z, and how it is written.
struct PcdOptions {
  bool normals = false;
  bool piece = false;
  bool reason = false;
  /// Subtracted from all positions and stated in the header as `# origin X Y Z`, which readPicks adds again.
  std::optional<Vector3> origin = {};
  bool doubles = false; ///< float64 x y z; PCL's readers of PointXYZ and pcl_viewer take them for zeros
  unsigned threads = 0; ///< 0: one per processor; the file does not depend on it
};

/// One point of a PCD.
struct PcdPoint {
  Vector3 position;
  Vector3 normal = Vector3::Zero();
  Index piece = -1;
  std::uint8_t reason = 0;
};

/// Writes a binary PCD for pcl_viewer: float32 x y z; then, where \a options ask for them, float32 normal_x normal_y normal_z, uint32
/// label (the piece, counted from 1; 0: none), by which pcl_viewer colours at once, and uint8 reason.
///
/// \param[in] count number of points
/// \param[in] point gives point i; called from several threads at once
/// pcl_viewer draws float32 only, so points should be in the local frame: float32 steps are 0.5 at
/// UTM northings. VIEWPOINT is the identity. The file appears only when it is complete.
/// \throw WriteError if the file cannot be written
void writePcd(const std::string& path, std::size_t count, const std::function<PcdPoint(std::size_t)>& point, const PcdOptions& options);

/// The same from arrays; those that are there are written.
/// \throw InvalidInputError if an array has a wrong length
/// \throw WriteError if the file cannot be written
void writePcd(const std::string& path, const LabelledPoints& cloud, unsigned threads = 0);

/// Writes rows `x y z`, each number the shortest that reads back as the same double. Errors as
/// writePcd.
void writeXyz(const std::string& path, const Points& points, unsigned threads = 0);

/// The sticks of a fault and its name.
struct NamedSticks {
  std::string name;
  std::vector<FaultStick> sticks;
};

/// What a GOCAD file of points or lines says beside them.
struct GocadFrame {
  ZPositive z_positive = ZPositive::Unknown; ///< Unknown is written as Elevation
  std::string xy_unit = "m";
  std::string z_unit = "m";
};

/// Writes points as a GOCAD VSet. Errors as writePcd.
void writeVset(const std::string& path, const std::string& name, const Points& points, const GocadFrame& frame = {});

/// Writes a GOCAD PLine per fault, an ILINE per stick. Errors as writePcd.
void writePline(const std::string& path, const std::vector<NamedSticks>& faults, const GocadFrame& frame = {});

/// Writes rows X,Y,Z,name,stick,node as .csv with these names in the header; sticks and nodes count from 1. Errors as writePcd.
/// \param[in] z_name name of the column of z
void writeStickTable(const std::string& path, const std::vector<NamedSticks>& faults, const std::string& z_name = "Z");

/// Writes sticks as IRAP/RMS lines: rows `x y z`, each stick ended by `999 999 999`. Errors as
/// writePcd.
void writePol(const std::string& path, const std::vector<FaultStick>& sticks);

} // namespace graben
GRABEN_EXPORT_END
