#include "support/recognise.h"

#include "graben/core/errors.h"
#include "graben/io/extension.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace graben {
namespace {

bool isCloud(const FaultInput& fault) {
  const auto* mesh = std::get_if<TriangleMesh>(&fault.geometry);
  return mesh != nullptr && mesh->triangles.empty();
}

/// A table whose z turns back may be sticks as well as picks row by row.
bool isGuessed(const FaultInput& fault) {
  const auto says_so = [](const std::string& note) { return note.find("told apart where z turns back") != std::string::npos; };
  return std::any_of(fault.notes.begin(), fault.notes.end(), says_so);
}

/// Sticks are several lines of a few points each.
bool areSticks(const std::vector<FaultInput>& faults) {
  if (std::any_of(faults.begin(), faults.end(), isGuessed))
    return false;
  constexpr std::size_t most_in_stick = 2000;
  std::size_t sticks = 0;
  std::size_t nodes = 0;
  for (const FaultInput& fault : faults)
    if (const auto* lines = std::get_if<std::vector<FaultStick>>(&fault.geometry))
      for (const FaultStick& stick : *lines) {
        ++sticks;
        nodes += stick.points.size();
      }
  return sticks > 1 && nodes <= most_in_stick * sticks;
}

/// Lines that lie flat and have many points are a horizon's, picked line by line.
bool areLinesOfAHorizon(const std::vector<FaultInput>& faults) {
  constexpr std::size_t fewest_points = 8;
  constexpr std::size_t fewest_lines = 3;
  constexpr double flat = 0.2;
  std::size_t lines = 0;
  for (const FaultInput& fault : faults)
    if (const auto* sticks = std::get_if<std::vector<FaultStick>>(&fault.geometry))
      for (const FaultStick& stick : *sticks) {
        double up = 0.0;
        double along = 0.0;
        for (std::size_t i = 1; i < stick.points.size(); ++i) {
          up += std::abs(stick.points[i].z() - stick.points[i - 1].z());
          along += (stick.points[i] - stick.points[i - 1]).head<2>().norm();
        }
        if (stick.points.size() < fewest_points || up > flat * along)
          return false;
        ++lines;
      }
  return lines >= fewest_lines;
}

/// Files of lines by their name.
bool isNamedForLines(const std::string& path) {
  const std::string extension = extensionOf(path);
  return extension == ".pol" || extension == ".pl" || extension == ".bln";
}

std::vector<PickSet> readHorizons(const PickSource& source, ReadOptions options, bool all) {
  options.horizon = source.horizon;
  std::vector<PickSet> sets;
  try {
    sets.push_back(readPicks(source.path, options));
  } catch (const SeveralHorizonsError& several) {
    if (!all)
      throw;
    for (const std::string& name : several.names()) {
      options.horizon = name;
      sets.push_back(readPicks(source.path, options));
    }
  }
  return sets;
}

} // namespace

ContentKind contentKind(std::size_t choice) {
  constexpr ContentKind kinds[] = {ContentKind::Auto, ContentKind::Picks, ContentKind::Fault, ContentKind::Surface};
  return kinds[choice];
}

std::vector<std::string> Recognised::notes() const {
  std::vector<std::string> all;
  for (const PickSet& set : picks)
    all.insert(all.end(), set.notes.begin(), set.notes.end());
  for (const FaultInput& fault : faults)
    all.insert(all.end(), fault.notes.begin(), fault.notes.end());
  return all;
}

std::vector<std::string> Recognised::warnings() const {
  std::vector<std::string> all;
  for (const PickSet& set : picks)
    all.insert(all.end(), set.warnings.begin(), set.warnings.end());
  for (const FaultInput& fault : faults)
    all.insert(all.end(), fault.warnings.begin(), fault.warnings.end());
  return all;
}

Recognised recognise(const PickSource& source, const ReadOptions& options, ContentKind kind, bool all_horizons) {
  Recognised found;
  const bool must_be_picks = kind == ContentKind::Picks || !source.horizon.empty() || !options.columns.empty();
  std::optional<ParseError> no_fault;
  if (!must_be_picks) {
    try {
      found.faults = readFaults(source.path);
      const bool surface =
          std::any_of(found.faults.begin(), found.faults.end(), [](const FaultInput& f) { return f.geometry.index() == 0 && !isCloud(f); });
      const bool sticks = areSticks(found.faults) && (isNamedForLines(source.path) || !areLinesOfAHorizon(found.faults));
      if (kind != ContentKind::Auto || surface || sticks)
        return found;
    } catch (const ParseError& error) {
      if (kind != ContentKind::Auto)
        throw;
      no_fault = error;
    }
    found.faults.clear();
  }
  found.picks = readHorizons(source, options, all_horizons);
  return found;
}

} // namespace graben
