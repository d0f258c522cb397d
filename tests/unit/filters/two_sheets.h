#pragma once

#include "graben/faults/fault_network.h"

namespace graben::test {

/// Two level sheets of picks 10 apart, z = 0 for x < 0 and z = 40 for x > 0, and a vertical fault
/// at x = 0 between them.
struct TwoSheets {
  TwoSheets() {
    for (int i = -20; i < 20; ++i)
      for (int j = -20; j <= 20; ++j)
        points.emplace_back(10.0 * i + 5.0, 10.0 * j, i < 0 ? 0.0 : 40.0);
  }

  static FaultSurface faultAt(double x, double dip_run = 0.0) {
    TriangleMesh mesh;
    mesh.vertices = {{x + dip_run, -400.0, -200.0},
                     {x + dip_run, 400.0, -200.0},
                     {x - dip_run, 400.0, 200.0},
                     {x - dip_run, -400.0, 200.0}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    return FaultSurface::fromMesh("F", mesh);
  }

  Index add(double x, double y, double z) {
    points.emplace_back(x, y, z);
    return static_cast<Index>(points.size()) - 1;
  }

  Points points;
  FaultNetwork faults{{faultAt(0.0)}};
};

} // namespace graben::test
