#pragma once

#include "graben/core/types.h"

#include <optional>
#include <string_view>
#include <vector>

namespace graben {

/// What a line `comment origin X Y Z` of a header says, which is to be added to all positions; none if it is another line or not three finite numbers.
/// \param[in] comment the word that comments of the format start with
std::optional<Vector3> statedOrigin(const std::vector<std::string_view>& words, std::string_view comment);

} // namespace graben
