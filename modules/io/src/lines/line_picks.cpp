// Horizons along seismic lines: Charisma and IESX.
#include "lines/charisma.h"
#include "lines/iesx.h"
#include "picks/pick_columns.h"
#include "picks/pick_formats.h"

#include "graben/core/errors.h"

#include <algorithm>

namespace graben {
namespace {

/// The number of the horizon asked for among several, or of the only one.
std::size_t chooseHorizon(const std::vector<std::string>& names, const PickFile& file) {
  if (file.options.horizon.empty()) {
    if (names.size() > 1)
      throw SeveralHorizonsError(file.path, severalHorizons(names), names);
    return 0;
  }
  requireHorizon(names, file);
  return static_cast<std::size_t>(std::find(names.begin(), names.end(), file.options.horizon) - names.begin());
}

} // namespace

PickSet readIesxPicks(std::string_view text, const PickFile& file) {
  const std::vector<IesxProfile> profiles = readIesx(text, file.path);
  std::vector<std::string> names;
  for (const IesxProfile& profile : profiles) {
    if (profile.fault)
      throw ParseError(file.path, 0, "holds fault sticks (IESX, '" + profile.name + "'), no horizon: give it as --fault");
    names.push_back(profile.name);
  }
  if (profiles.empty())
    throw ParseError(file.path, 0, "holds no PROFILE");
  const IesxProfile& chosen = profiles[chooseHorizon(names, file)];
  PickSet picks;
  for (const IesxRow& row : chosen.rows)
    picks.points.push_back(row.point);
  picks.format = "IESX lines";
  picks.layout = "x y segment code z";
  picks.notes.push_back("columns 1, 2, 5 of an IESX file taken as x, y, z");
  picks.horizon = chosen.name;
  picks.xy_unit = chosen.xy_unit;
  picks.z_unit = chosen.z_unit;
  return picks;
}

PickSet readCharismaPicks(std::string_view text, const PickFile& file) {
  CharismaHorizons horizons = readCharismaHorizons(text, file.path);
  const std::size_t chosen = chooseHorizon(horizons.names, file);
  PickSet picks;
  picks.points = std::move(horizons.points[chosen]);
  picks.horizon = horizons.names[chosen];
  picks.format = "Charisma horizon";
  picks.layout = "INLINE inline XLINE crossline x y z";
  return picks;
}

} // namespace graben
