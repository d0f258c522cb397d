#pragma once

#include "graben/core/export.h"

#include <string>

GRABEN_EXPORT_BEGIN
namespace graben {

/// A path's extension in lower case with its dot; empty if it has none.
std::string extensionOf(const std::string& path);

} // namespace graben
GRABEN_EXPORT_END
