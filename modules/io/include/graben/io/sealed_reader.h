#pragma once

#include "graben/core/export.h"
#include "graben/mesh/sealed_mesh.h"

#include <string>

GRABEN_EXPORT_BEGIN
namespace graben {

/// A closed model read back from the results folder of graben_model.
struct SealedInput {
  SealedMesh mesh; ///< fault_side of its blocks is empty
  std::vector<std::string> layer_names; ///< of each block
  ZPositive z_positive = ZPositive::Unknown;
};

/// Reads model.msh, patches.csv and blocks.csv of a folder.
/// \param[in] path the folder, or one of these files in it
/// \throw IoError if a file is not there; ParseError if one is not as writeGmsh and graben_model write it, or they do not fit together
SealedInput readSealed(const std::string& path);

} // namespace graben
GRABEN_EXPORT_END
