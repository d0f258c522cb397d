#pragma once

#include "support/takeaways.h"

#include "graben/visualization/picture_formats.h"

#include <set>
#include <string>

namespace graben {

/// Which pictures go with a horizon, and how they are written.
struct PictureChoice {
  std::set<std::string> names;
  PictureFormats formats;
  std::string options; ///< what the user asked for, for the report's page

  bool has(const std::string& name) const { return names.count(name) > 0; }
};

/// Declares --pictures and --picture-formats.
void declarePictureOptions(OptionParser& parser);

/// \throw UsageError if there is no such picture or format
PictureChoice pictureChoice(const OptionValues& values);

/// Draws the pictures chosen into \a dir, last the page of the report with them. \return sentences for the user: which were left out, and why
std::vector<std::string> drawPictures(const std::filesystem::path& dir, const ReconstructionResult& result, const UnitNames& units,
                                      const PictureChoice& choice);

} // namespace graben
