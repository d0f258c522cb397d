#include "drawing/picture_file.h"

#include "graben/core/atomic_file.h"
#include "graben/core/errors.h"

#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkRenderWindow.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>

namespace graben {

void checkPictureSize(int width, int height) {
  constexpr int kLeast = 64;
  constexpr int kMost = 16384;
  if (width < kLeast || height < kLeast || width > kMost || height > kMost)
    throw InvalidInputError("drawing a picture", "its width and height must be from 64 to 16384 pixels");
}

void writePicture(vtkRenderWindow* window, const std::string& png) {
  window->Render();
  vtkNew<vtkWindowToImageFilter> image;
  image->SetInput(window);
  image->ReadFrontBufferOff();
  vtkNew<vtkPNGWriter> encoder;
  encoder->WriteToMemoryOn();
  encoder->SetInputConnection(image->GetOutputPort());
  encoder->Write();
  vtkUnsignedCharArray* bytes = encoder->GetResult();
  if (bytes == nullptr || bytes->GetNumberOfValues() == 0)
    throw Error("drawing a picture", "the display gave back no image");

  writeFile(png, {reinterpret_cast<const char*>(bytes->GetPointer(0)), static_cast<std::size_t>(bytes->GetNumberOfValues())});
}

} // namespace graben
