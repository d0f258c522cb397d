#pragma once

#include <string>

namespace graben {

/// A number for a sentence, in four figures: "205.3", "1.2e+06".
std::string shortNumber(double value);

} // namespace graben
