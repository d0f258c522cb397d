#pragma once

#include "graben/faults/fault_surface.h"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>

namespace graben::test {

/// Sticks of an RMS .pol file whose z grows downward, about a fixed origin inside the Drogon field.
inline std::vector<FaultStick> readPol(const std::string& file) {
  std::ifstream in(file);
  std::vector<FaultStick> sticks(1);
  for (Vector3 p; in >> p.x() >> p.y() >> p.z();)
    if (p.x() == 999.0)
      sticks.emplace_back();
    else
      sticks.back().points.emplace_back(p.x() - 462000.0, p.y() - 5932000.0, 1650.0 - p.z());
  return sticks;
}

/// The vertices and triangles of a GOCAD TSurf about an origin.
inline TriangleMesh readTsurf(const std::string& file, const Vector3& origin) {
  std::ifstream in(file);
  TriangleMesh mesh;
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string key;
    words >> key;
    if (key == "VRTX" || key == "PVRTX") {
      Index id = 0;
      Vector3 p;
      words >> id >> p.x() >> p.y() >> p.z();
      mesh.vertices.resize(
          static_cast<std::size_t>(std::max<Index>(id, static_cast<Index>(mesh.vertices.size()))),
          origin);
      mesh.vertices[static_cast<std::size_t>(id - 1)] = p;
    } else if (key == "TRGL") {
      Triangle t;
      words >> t[0] >> t[1] >> t[2];
      mesh.triangles.push_back({t[0] - 1, t[1] - 1, t[2] - 1});
    }
  }
  for (Vector3& p : mesh.vertices)
    p -= origin;
  return mesh;
}

} // namespace graben::test
