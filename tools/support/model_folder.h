#pragma once

#include "graben/core/file_set.h"
#include "graben/pipeline/model_reconstruction.h"

#include <string>
#include <vector>

namespace graben {

/// The name of an object as that of a file.
std::string fileNameOf(const std::string& name);

/// What the files of a model's results folder are told from others in it by.
const FileSetNames& modelSet();

/// Writes a model's results folder, all at once (see FileSet): what is closed as blocks, or else defects.vtp and the horizons alone.
/// \return sentences for the user
std::vector<std::string> writeModelFolder(const std::string& folder, const ModelResult& result);

/// A model alone, in the format its extension says: .msh (with .geo), .ml or .vtm.
void writeModelFile(const std::string& path, const ModelResult& result);

/// The model's report as JSON, with a fixed order of keys.
std::string modelJson(const ModelResult& result);

} // namespace graben
