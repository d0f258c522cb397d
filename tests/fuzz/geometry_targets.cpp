// Sticks, the fault network, the cutter and the whole job on random faults and picks. Coordinates are small whole numbers, so that points,
// edges and planes coincide all the time.
#include "fuzz_targets.h"

#include "graben/core/errors.h"
#include "graben/faults/fault_network.h"
#include "graben/pipeline/horizon_reconstruction.h"
#include "graben/surface/fault_cut.h"

#include <cmath>

namespace graben::test {
namespace {

/// Numbers out of bytes; zeros when they are used up.
class Bytes {
public:
  Bytes(const std::uint8_t* bytes, std::size_t size)
      : next_(bytes)
      , end_(bytes + size) {}

  bool empty() const { return next_ == end_; }
  int byte() { return empty() ? 0 : *next_++; }
  int below(int count) { return byte() % count; }

  /// Mostly one of 32 places, now and then something absurd.
  double coordinate() {
    constexpr double odd[] = {1e9, -1e9, 1e200, 1e-9, 0.1, 1.0 / 3.0, -0.0, 7.0000001};
    const int b = byte();
    return b >= 248 ? odd[b - 248] : 0.5 * (b % 32);
  }

  Vector3 point() {
    const double x = coordinate();
    const double y = coordinate();
    return {x, y, coordinate()};
  }

  /// Few vertices, so that triangles share them in every way.
  TriangleMesh mesh(int most_triangles) {
    TriangleMesh mesh;
    const int vertices = 3 + below(12);
    for (int i = 0; i < vertices; ++i)
      mesh.vertices.push_back(point());
    const int triangles = 1 + below(most_triangles);
    for (int i = 0; i < triangles; ++i) {
      const Index a = below(vertices);
      const Index b = below(vertices);
      mesh.triangles.push_back({a, b, below(vertices)});
    }
    return mesh;
  }

  std::vector<FaultStick> sticks() {
    std::vector<FaultStick> sticks(static_cast<std::size_t>(1 + below(6)));
    for (FaultStick& stick : sticks)
      for (int points = below(5); points >= 0; --points)
        stick.points.push_back(point());
    return sticks;
  }

private:
  const std::uint8_t* next_;
  const std::uint8_t* end_;
};

FaultNetwork networkOf(Bytes& bytes) {
  std::vector<FaultSurface> faults;
  for (int count = bytes.below(4); count >= 0; --count)
    faults.push_back(FaultSurface::fromMesh("F" + std::to_string(count), bytes.mesh(12)));
  return FaultNetwork(std::move(faults), 0.25 * bytes.below(16));
}

void loft(Bytes& bytes) {
  const FaultSurface fault = FaultSurface::loft("F", bytes.sticks(), 0.5 * bytes.below(8));
  validate(fault.mesh, "fuzzing", 1);
  require(!fault.mesh.empty(), "a fault has triangles");
}

void askNetwork(Bytes& bytes) {
  const FaultNetwork network = networkOf(bytes);
  for (int question = 0; question < 8; ++question) {
    const Vector3 a = bytes.point();
    const Vector3 b = bytes.point();
    const bool crosses = network.crosses(a, b);
    require(crosses == network.crosses(b, a), "a segment crosses a fault from either end");
    const auto first = network.firstCrossing(a, b);
    require(first.has_value() == crosses, "what crosses has a first crossing");
    require(!first || (first->parameter >= 0.0 && first->parameter <= 1.0 && first->point.allFinite()), "a crossing lies on its segment");
    const FaultPoint nearest = network.nearest(a);
    require(nearest.fault >= 0 && nearest.distance >= 0.0, "a fault is nearest");
    network.side(0, a);
    network.separates(0, a, b);
  }
}

void cut(Bytes& bytes) {
  const FaultNetwork network = networkOf(bytes);
  FaultCutOptions options;
  options.tolerance = 0.125 * bytes.below(4);
  options.threads = 1;
  const CutMesh cut = cutAlongFaults(bytes.mesh(24), network, options);
  validate(cut.mesh, "fuzzing", 1);
  require(cut.vertex_faults.size() == cut.mesh.vertices.size(), "each vertex says its faults");
}

/// Picks on a bent horizon, thrown at places, with holes and strays; faults as sticks or meshes.
Points picksOf(Bytes& bytes) {
  Points picks;
  const int columns = 4 + bytes.below(12);
  for (int i = 0; i < 12 * columns; ++i) {
    const int what = i % 6 == 0 ? bytes.byte() : 128;
    if (what < 8)
      continue;
    const double x = i / 12 * 16.0 / columns;
    picks.push_back({x, 1.25 * (i % 12), 8.0 + std::sin(0.4 * x) + (what > 240 ? what - 240 : 0)});
  }
  for (int strays = bytes.below(8); strays > 0; --strays)
    picks.push_back(bytes.point());
  return picks;
}

void reconstruct(Bytes& bytes) {
  std::vector<FaultInput> faults;
  for (int count = bytes.below(4); count > 0; --count) {
    if (bytes.below(2) == 0)
      faults.push_back({"F" + std::to_string(count), bytes.mesh(12)});
    else
      faults.push_back({"F" + std::to_string(count), bytes.sticks()});
  }
  ReconstructionOptions options;
  options.threads = 1;
  options.memory_limit = std::size_t{2} << 30;
  const ReconstructionResult result = HorizonReconstruction(options).reconstruct(picksOf(bytes), faults);
  validate(result.mesh, "fuzzing", 1);
  require(!result.mesh.empty(), "a surface has triangles");
}

template <void (*work)(Bytes&)>
void runGeometry(const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, size);
  try {
    work(bytes);
  } catch (const Error& error) {
    require(error.what()[0] != '\0', "errors say something");
  }
}

} // namespace

const std::vector<FuzzTarget>& geometryTargets() {
  static const std::vector<FuzzTarget> targets = {
      {"sticks", runGeometry<loft>, 512},
      {"network", runGeometry<askNetwork>, 512},
      {"cutter", runGeometry<cut>, 512},
      {"job", runGeometry<reconstruct>, 512},
  };
  return targets;
}

} // namespace graben::test
