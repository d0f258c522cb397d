#pragma once

#include <string>

class vtkRenderWindow;

namespace graben {

/// Renders the window and writes what it shows as PNG, beside its place first, then renamed.
/// \throw WriteError if the file cannot be written
void writePicture(vtkRenderWindow* window, const std::string& png);

/// \throw InvalidInputError unless both are from 64 to 16384
void checkPictureSize(int width, int height);

} // namespace graben
