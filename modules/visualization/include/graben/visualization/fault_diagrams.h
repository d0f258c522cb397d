#pragma once

#include "graben/core/export.h"
#include "graben/visualization/map_picture.h"

#include <string>
#include <vector>

GRABEN_EXPORT_BEGIN
namespace graben {

/// What a fault does to one horizon along its strike, for diagrams: arrays of one length.
struct FaultCurve {
  std::string name;                 ///< of the horizon
  std::vector<double> along;        ///< distance along strike, rising
  std::vector<double> throw_;       ///< positive where the hanging wall is down
  std::vector<double> throw_low;    ///< P10 and P90; or empty
  std::vector<double> throw_high;
  std::vector<double> footwall;     ///< z of the cutoffs
  std::vector<double> hanging_wall;
  double gap = 0.0;                 ///< two places farther apart than this are not joined; 0: all are
};

struct DiagramOptions {
  PictureUnits units;
  PictureFormats formats;
  std::string title;
  int width = 1200; ///< pixels
  int height = 560; ///< pixels
};

/// Draws throw against distance along strike, with its band from P10 to P90, as STEM.png, STEM.svg or STEM.pdf. Needs no display.
/// \throw InvalidInputError if the curve is empty or its arrays differ in length; IoError if a file cannot be written
void drawThrowProfile(const std::string& stem, const FaultCurve& curve, const DiagramOptions& options = {});

/// Draws an Allan diagram: the footwall's and the hanging wall's cutoffs of one or more horizons on the fault plane, z against distance along strike.
/// Errors as drawThrowProfile, also if there is no curve.
void drawAllanDiagram(const std::string& stem, const std::vector<FaultCurve>& horizons, const DiagramOptions& options = {});

} // namespace graben
GRABEN_EXPORT_END
