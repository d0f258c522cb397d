#pragma once

#include "graben/io/pick_writer.h"

#include <string>

namespace graben {

/// The start of a GOCAD object up to its geometry: type, name and coordinate system, in the form that strict readers take.
std::string gocadHeader(const std::string& type, const std::string& name, const GocadFrame& frame);

} // namespace graben
