#pragma once

#include "graben/io/pick_reader.h"

#include <string>
#include <string_view>

namespace graben {

/// One reader per format; \a bytes is the whole file, \a path is for messages. Null values are
/// still in what they return.
PickSet readTextPicks(std::string_view bytes, const std::string& path, const ReadOptions& options);
PickSet readPcdPicks(std::string_view bytes, const std::string& path, const ReadOptions& options);
PickSet readPlyPicks(std::string_view bytes, const std::string& path);
PickSet readGocadPicks(std::string_view bytes, const std::string& path);

} // namespace graben
