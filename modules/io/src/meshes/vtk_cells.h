#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace graben {

/// Takes the corners of a polygon, as numbers of points.
using AddPolygon = std::function<void(const std::vector<double>& corners)>;

/// The quadrangles between the points of a structured grid.
/// \returns false if it is no surface: not one of its sizes is 1, or another is less than 2
bool addGridPolygons(const std::array<std::size_t, 3>& points, const AddPolygon& add);

/// The polygons of a cell of a VTK type.
/// \returns false if the cell is none: a volume, line or point
bool addCellPolygons(int type, const std::vector<double>& corners, const AddPolygon& add);

/// "2 x 3 x 1".
std::string gridSize(const std::array<std::size_t, 3>& points);

} // namespace graben
