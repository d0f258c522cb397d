#include "graben/core/local_frame.h"

#include "graben/core/errors.h"
#include "graben/core/threads.h"

#include <cmath>
#include <limits>

namespace graben {

namespace {

constexpr std::size_t GRAIN = 1 << 16;

struct Box {
  Vector3 low = Vector3::Constant(std::numeric_limits<double>::infinity()), high = -low;

  void extend(const Vector3& from, const Vector3& to) {
    low = low.cwiseMin(from);
    high = high.cwiseMax(to);
  }
};

/// Of the finite points.
Box boxOf(const Points& points, unsigned threads) {
  std::vector<Box> parts((points.size() + GRAIN - 1) / GRAIN);
  parallelBlocks(points.size(), GRAIN, threads, [&](std::size_t begin, std::size_t end) {
    Box part;
    for (std::size_t i = begin; i < end; ++i)
      if (points[i].allFinite())
        part.extend(points[i], points[i]);
    parts[begin / GRAIN] = part;
  });
  Box all;
  for (const Box& part : parts)
    all.extend(part.low, part.high);
  return all;
}

} // namespace

LocalFrame LocalFrame::around(const Points& points, ZPositive z_positive, double z_scale, unsigned threads) {
  if (!(z_scale > 0.0) || !std::isfinite(z_scale))
    throw InvalidInputError("local frame", "the z scale must be a positive number");
  const Box box = boxOf(points, threads);
  const Vector3 &low = box.low, &high = box.high;
  if (!low.allFinite())
    throw InvalidInputError("local frame", "no point has finite coordinates");
  LocalFrame frame;
  const Vector3 centre = 0.5 * (low + high);
  // Whole units keep the subtraction exact for coordinates given to the millimetre; a cloud
  // smaller than a unit stays where it is only if it is near zero already.
  const double size = (high - low).maxCoeff();
  const double unit = size > 10.0 ? 1.0 : (size > 0.0 ? std::pow(2.0, std::floor(std::log2(size / 10.0))) : 1.0);
  frame.origin = (centre / unit).array().round().matrix() * unit;
  frame.z_scale = z_scale;
  frame.z_positive = z_positive == ZPositive::Down ? ZPositive::Down : ZPositive::Up;
  return frame;
}

Vector3 LocalFrame::toLocal(const Vector3& user) const {
  Vector3 p = user - origin;
  p.z() *= zFactor();
  return p;
}

Vector3 LocalFrame::toUser(const Vector3& local) const {
  return {local.x() + origin.x(), local.y() + origin.y(), local.z() / zFactor() + origin.z()};
}

Vector3 LocalFrame::normalToUser(const Vector3& local) const {
  Vector3 n(local.x(), local.y(), local.z() * zFactor());
  const double length = n.norm();
  return length > 0.0 ? Vector3(n / length) : local;
}

Vector3 LocalFrame::normalToLocal(const Vector3& user) const {
  Vector3 n(user.x(), user.y(), user.z() / zFactor());
  const double length = n.norm();
  return length > 0.0 ? Vector3(n / length) : user;
}

} // namespace graben
