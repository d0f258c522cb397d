#include "meshes/vtk_cells.h"

#include <algorithm>

namespace graben {

bool addGridPolygons(const std::array<std::size_t, 3>& points, const AddPolygon& add) {
  std::vector<std::size_t> sizes;
  std::copy_if(points.begin(), points.end(), std::back_inserter(sizes), [](std::size_t n) { return n != 1; });
  if (sizes.size() != 2 || sizes[0] < 2 || sizes[1] < 2)
    return false;
  for (std::size_t j = 0; j + 1 < sizes[1]; ++j)
    for (std::size_t i = 0; i + 1 < sizes[0]; ++i) {
      const auto first = static_cast<double>(j * sizes[0] + i);
      const auto row = static_cast<double>(sizes[0]);
      add({first, first + 1.0, first + row + 1.0, first + row});
    }
  return true;
}

bool addCellPolygons(int type, const std::vector<double>& corners, const AddPolygon& add) {
  enum { Triangle = 5, Strip = 6, Polygon = 7, Pixel = 8, Quad = 9 };
  if (type == Pixel && corners.size() == 4)
    add({corners[0], corners[1], corners[3], corners[2]});
  else if (type == Triangle || type == Polygon || type == Quad)
    add(corners);
  else if (type == Strip)
    for (std::size_t i = 2; i < corners.size(); ++i)
      add(i % 2 == 0 ? std::vector<double>{corners[i - 2], corners[i - 1], corners[i]}
                     : std::vector<double>{corners[i - 1], corners[i - 2], corners[i]});
  else
    return false;
  return true;
}

std::string gridSize(const std::array<std::size_t, 3>& points) {
  return std::to_string(points[0]) + " x " + std::to_string(points[1]) + " x " + std::to_string(points[2]);
}

} // namespace graben
