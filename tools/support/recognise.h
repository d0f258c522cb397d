#pragma once

#include "graben/io/fault_reader.h"
#include "graben/io/pick_reader.h"

#include <string>
#include <vector>

namespace graben {

/// What a file may be.
enum class ContentKind { Auto, Picks, Fault, Surface };

/// The kind of number \a choice of auto, picks, fault, surface.
ContentKind contentKind(std::size_t choice);

/// A file as picks or as faults; one of the two is empty.
struct Recognised {
  std::vector<PickSet> picks;     ///< one, or one for each horizon of a file that holds several
  std::vector<FaultInput> faults; ///< sticks, or surfaces of whatever use

  std::vector<std::string> notes() const;
  std::vector<std::string> warnings() const;
};

/// Reads a file as what it is: a mesh or sticks where it holds triangles or several lines, else picks.
/// \param[in] all_horizons each horizon of a file that holds several; else one must be named
/// \throw IoError, ParseError as the readers
Recognised recognise(const PickSource& source, const ReadOptions& options, ContentKind kind, bool all_horizons = false);

} // namespace graben
