#pragma once

#include "drawing/canvas.h"

#include "graben/mesh/triangle_mesh.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace graben {

/// What one triangle's corners look like: places in pixels, depth (larger is nearer), and a value or colour at each.
struct RasterTriangle {
  std::array<Eigen::Vector3d, 3> corners; ///< x, y in pixels, depth
  std::array<Color, 3> colors;
};

/// Draws triangles without a display: the nearest one wins in each of four samples a pixel.
class Raster {
public:
  Raster(int width, int height);

  /// \param[in] count    of triangles
  /// \param[in] triangle gives triangle i; called from several threads at once
  /// The image is the same for every number of threads. \param[in] opacity of these triangles over what was drawn before; hides nothing if less than 1
  void draw(std::size_t count, const std::function<RasterTriangle(std::size_t)>& triangle, double opacity = 1.0, unsigned threads = 0);

  /// The image over a transparent ground.
  Pixels pixels() const;

private:
  void drawRows(const RasterTriangle& t, int first, int last, double opacity);

  int width_, height_; ///< of the image
  std::vector<float> depth_;
  std::vector<std::array<float, 4>> color_; ///< red, green, blue, opacity of each sample
};

} // namespace graben
