#pragma once

#include "graben/core/export.h"

GRABEN_EXPORT_BEGIN
namespace graben {

/// What two-dimensional pictures are written as; SVG and PDF are drawn of lines and letters and can be edited.
struct PictureFormats {
  bool png = true;
  bool svg = true;
  bool pdf = false;
};

} // namespace graben
GRABEN_EXPORT_END
