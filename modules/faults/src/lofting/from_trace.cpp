#include "lofting/from_trace.h"

#include "graben/core/errors.h"

#include <algorithm>
#include <cmath>

namespace graben::detail {
namespace {

constexpr double kUpright = 90.0 - 1e-9;
constexpr double kBeyond = 0.1;   // of the trace's length, or of the horizon's height: how far the fault goes beyond the horizon
constexpr double kRadian = M_PI / 180.0;

/// Level and square to the trace, on the side of the azimuth.
Vector3 across(const FaultStick& trace, double azimuth) {
  const Vector3 run = trace.points.back() - trace.points.front();
  const Vector3 square = Vector3(run.y(), -run.x(), 0.0).normalized();
  const Vector3 wanted(std::sin(azimuth * kRadian), std::cos(azimuth * kRadian), 0.0);
  return square.dot(wanted) < 0.0 ? Vector3(-square) : square;
}

} // namespace

FaultSurface faultFromTrace(const std::string& name, const FaultStick& trace, const TraceDip& dip, const Bounds& horizon) {
  const std::string stage = "making fault " + name + " from its trace";
  if (!(dip.dip > 0.0 && dip.dip <= 90.0))
    throw InvalidInputError(stage, "Its dip must be over 0 and up to 90 degrees.");
  Vector3 down(0.0, 0.0, -1.0);
  if (dip.dip < kUpright) {
    if (!dip.azimuth)
      throw InvalidInputError(stage, "Say which way it dips too: --fault-dip DEG,AZIMUTH, the azimuth in degrees clockwise from north.");
    down = std::cos(dip.dip * kRadian) * across(trace, *dip.azimuth) - std::sin(dip.dip * kRadian) * Vector3::UnitZ();
  }
  Bounds box = boundsOf(trace.points);
  const double length = box.diagonal();
  if (!horizon.empty())
    box.extend(horizon);
  const double beyond = kBeyond * std::max(length, box.size().z());
  const double top = box.high.z() + beyond;
  const double bottom = box.low.z() - beyond;
  TriangleMesh mesh;
  for (const Vector3& p : trace.points)
    for (const double z : {top, p.z(), bottom})
      mesh.vertices.push_back(p + (z - p.z()) / down.z() * down);
  for (std::size_t i = 0; i + 1 < trace.points.size(); ++i)
    for (Index k = 0; k < 2; ++k) {
      const auto a = static_cast<Index>(3 * i) + k;
      mesh.triangles.push_back({a, a + 1, a + 3});
      mesh.triangles.push_back({a + 3, a + 1, a + 4});
    }
  FaultSurface fault = FaultSurface::fromMesh(name, mesh);
  const auto last = mesh.vertices.end();
  fault.tip_lines = {Points(mesh.vertices.begin(), mesh.vertices.begin() + 3), Points(last - 3, last)};
  return fault;
}

} // namespace graben::detail
