#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

namespace graben::peer {

using Point = std::array<float, 3>;

/// What every peer program is given on its command line; see tests/benchmark/README.md.
struct Arguments {
  std::string input;    ///< binary PCD
  std::string output;   ///< binary PLY; "-" writes nothing
  double voxel = 0.0;   ///< edge of a cell, twice the spacing of the points
  int threads = 0;      ///< 0: one per processor
  bool object = false;  ///< normals point away from the middle of the cloud, not up
  bool weld = false;    ///< join vertices closer than voxel / 1000 and leave out those without a triangle
  double trim = 0.0;    ///< leave out triangles with a vertex farther than this from the points; 0: none
};

/// Points about an origin at the middle of their box, so that UTM coordinates survive single precision.
struct Cloud {
  std::array<double, 3> origin{};
  std::vector<Point> points;
  Point size{}; ///< of the bounding box
};

struct Mesh {
  std::vector<Point> vertices; ///< about the cloud's origin
  std::vector<Point> normals;  ///< one per vertex or none
  std::vector<std::array<std::int32_t, 3>> triangles;
};

/// Ends the program with exit code 2 and the usage where the arguments cannot be used. needs_voxel: --voxel has to be given.
Arguments parseArguments(int argc, char** argv, bool needs_voxel);

/// Reads x y z, float or double, of a binary PCD. Throws std::runtime_error.
Cloud readPcd(const std::string& path);

/// Writes vertices as doubles about the file's own origin, after what the arguments ask for has been done to the mesh.
void writePly(const Arguments& arguments, const Cloud& cloud, Mesh& mesh);

/// The point that normals are to look at so that they point up; with --object the middle, from which they then have to be turned away.
Point viewpoint(const Arguments& arguments, const Cloud& cloud);

/// Prints 'time NAME SECONDS' to standard output for the time since it was made or last asked.
class Stopwatch {
public:
  void lap(const char* name);

private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// Runs body(arguments, cloud, mesh) between reading and writing; exit code 1 and one line where something throws.
int run(int argc, char** argv, bool needs_voxel, void (*body)(const Arguments&, const Cloud&, Mesh&));

} // namespace graben::peer
