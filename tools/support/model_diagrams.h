#pragma once

#include "graben/pipeline/model_reconstruction.h"

#include <filesystem>

namespace graben {

/// Draws, for each fault of a model, the cutoffs of all horizons it cuts on its plane: allan_N_NAME.png and .svg. Makes the folder where there are any.
void drawAllanDiagrams(const std::filesystem::path& dir, const ModelResult& result);

} // namespace graben
