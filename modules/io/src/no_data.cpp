#include "no_data.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace graben {
namespace {

/// -999 and -9999 are null values in many files and honest elevations in some.
bool isDoubtful(double z) {
  return z == -999.0 || z == -9999.0;
}

bool isFinitePoint(const Vector3& p) {
  return std::abs(p.x()) < 1e29 && std::abs(p.y()) < 1e29 && std::isfinite(p.x() + p.y());
}

enum class Kind { Point, Terminator, NoData };

/// Tells points from rows without data.
class Judge {
public:
  Judge(const Points& points, bool terminators)
      : terminators_(terminators) {
    for (const Vector3& p : points) {
      if (basicKind(p) == Kind::Point && !isDoubtful(p.z())) {
        low_ = std::min(low_, p.z());
        high_ = std::max(high_, p.z());
      }
    }
  }

  Kind kind(const Vector3& p) const {
    const Kind basic = basicKind(p);
    if (basic == Kind::Point && isDoubtful(p.z()) && low_ <= high_) {
      const double away = std::max(low_ - p.z(), p.z() - high_);
      if (away > std::max(high_ - low_, 1.0))
        return Kind::NoData;
    }
    return basic;
  }

private:
  Kind basicKind(const Vector3& p) const {
    if (terminators_ && isTerminator(p))
      return Kind::Terminator;
    return isFinitePoint(p) && !isNullValue(p.z()) ? Kind::Point : Kind::NoData;
  }

  bool terminators_;
  double low_ = std::numeric_limits<double>::infinity();
  double high_ = -std::numeric_limits<double>::infinity();
};

} // namespace

bool isNullValue(double value) {
  return !std::isfinite(value) || std::abs(value) >= 1e29 || std::abs(value) == 999.25 ||
         value == -99999.0;
}

bool isTerminator(const Vector3& point) {
  return point.x() == 999.0 && point.y() == 999.0 && point.z() == 999.0;
}

void dropNoData(PickSet& picks, bool terminators) {
  const Judge judge(picks.points, terminators);
  std::size_t kept = 0;
  std::size_t ends = 0;
  std::size_t no_data = 0;
  for (std::size_t i = 0; i < picks.points.size(); ++i) {
    const Kind kind = judge.kind(picks.points[i]);
    ends += kind == Kind::Terminator ? 1 : 0;
    no_data += kind == Kind::NoData ? 1 : 0;
    if (kind != Kind::Point)
      continue;
    if (kept != i) {
      picks.points[kept] = picks.points[i];
      if (!picks.normals.empty())
        picks.normals[kept] = picks.normals[i];
    }
    ++kept;
  }
  picks.points.resize(kept);
  if (!picks.normals.empty())
    picks.normals.resize(kept);
  picks.no_data_rows += no_data;
  if (no_data > 0)
    picks.notes.push_back(std::to_string(no_data) +
                          " rows without data (null, not finite) dropped");
  if (ends > 0)
    picks.notes.push_back(std::to_string(ends) + " rows 999 999 999 (ends of lines) dropped");
}

} // namespace graben
