#pragma once

#include "content/file_content.h"

#include <string>
#include <string_view>

namespace graben {

/// What a file is, by its content and, where that leaves doubt, its extension.
enum class FileFormat { Text, Pcd, Ply, Gocad, VtkLegacy, VtkXml, Stl, Obj, Charisma, Cps3, Iesx, Grid };

/// The format of a file; Text where nothing else is recognised.
FileFormat formatOf(std::string_view bytes, const std::string& path);

/// A name for messages, for example "a GOCAD file".
std::string describe(FileFormat format);

} // namespace graben
