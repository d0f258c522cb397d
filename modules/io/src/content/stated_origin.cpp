#include "content/stated_origin.h"

#include "content/numbers.h"

#include <cmath>

namespace graben {

std::optional<Vector3> statedOrigin(const std::vector<std::string_view>& words, std::string_view comment) {
  if (words.size() != 5 || words[0] != comment || words[1] != "origin")
    return std::nullopt;
  Vector3 origin;
  for (std::size_t k = 0; k < 3; ++k)
    if (double& value = origin[static_cast<Eigen::Index>(k)]; !parseField(words[k + 2], value) || !std::isfinite(value))
      return std::nullopt;
  return origin;
}

} // namespace graben
