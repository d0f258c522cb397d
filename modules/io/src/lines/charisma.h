#pragma once

#include "graben/core/types.h"

#include <string>
#include <string_view>
#include <vector>

namespace graben {

/// The horizons of a Charisma file, which are told apart by a name behind z, if there is one.
struct CharismaHorizons {
  std::vector<std::string> names;
  std::vector<Points> points; ///< of each
};

/// Rows `INLINE : inline XLINE : crossline x y z [name]`.
/// \throw ParseError naming the line, if a row is unreadable or of a fault stick
CharismaHorizons readCharismaHorizons(std::string_view text, const std::string& path);

} // namespace graben
