#pragma once

#include "graben/io/sealed_reader.h"
#include "graben/model/model_section.h"

#include <set>
#include <string>
#include <vector>

namespace graben {

struct SectionFileOptions {
  std::set<std::string> formats; ///< of svg, png, pdf, dxf, vtp, csv
  double vertical_exaggeration = 0.0;
  Points picks;      ///< those within the band are drawn
  double band = 0.0; ///< 0: a hundredth of the section's length
};

/// Writes a section in all formats asked for, as FOLDER/NAME.svg and so on; with csv the areas in NAME.csv and the throws in NAME_throws.csv.
void writeSection(const std::string& folder, const std::string& name, const SealedInput& model, const ModelSection& section,
                  const SectionFileOptions& options);

} // namespace graben
