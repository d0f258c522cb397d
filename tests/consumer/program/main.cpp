#include <graben/faults/fault_network.h>
#include <graben/visualization/section.h>

#include <iostream>

int main() {
  graben::TriangleMesh wall;
  wall.vertices = {{0, -1, -1}, {0, 1, -1}, {0, 0, 1}};
  wall.triangles = {{0, 1, 2}};
  const graben::FaultNetwork faults({graben::FaultSurface::fromMesh("wall", wall)});
  const bool right = faults.crosses({-1, 0, 0}, {1, 0, 0}) && !faults.crosses({1, 0, 0}, {2, 0, 0}) &&
                     graben::cutMesh(wall, {{-1, 0, 0}, {1, 0, 0}}).size() == 1;
  std::cout << (right ? "graben works\n" : "graben gave a wrong answer\n");
  return right ? 0 : 1;
}
