#include "no_data.h"

#include "graben/core/threads.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

namespace graben {
namespace {

/// -999 and -9999 are null values in many files and honest elevations in some.
bool isDoubtful(double z) {
  return z == -999.0 || z == -9999.0;
}

bool isNull(double value) {
  const double size = std::abs(value);
  return !(size < 1e29) || size == 999.25 || value == -99999.0;
}

bool isLineEnd(const Vector3& p) {
  return p.x() == 999.0 && p.y() == 999.0 && p.z() == 999.0;
}

bool isFinitePoint(const Vector3& p) {
  return std::abs(p.x()) < 1e29 && std::abs(p.y()) < 1e29;
}

enum class Kind { Point, Terminator, NoData };

/// What z values there are; doubtful nulls apart.
struct Survey {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
};

Kind basicKind(const Vector3& p, bool terminators) {
  if (terminators && isLineEnd(p))
    return Kind::Terminator;
  return isFinitePoint(p) && !isNull(p.z()) ? Kind::Point : Kind::NoData;
}

/// True if every row is a point beyond doubt, as nearly always; false also for a few that are.
bool isClean(const Points& points, unsigned threads) {
  std::atomic<bool> clean{true};
  parallelBlocks(points.size(), 1 << 16, threads, [&](std::size_t begin, std::size_t end) {
    int odd = 0;
    for (std::size_t i = begin; i < end; ++i) {
      const Vector3& p = points[i];
      const double z = std::abs(p.z());
      const int far = (std::abs(p.x()) < 1e29 ? 0 : 1) | (std::abs(p.y()) < 1e29 ? 0 : 1) | (z < 1e29 ? 0 : 1);
      odd |= far | (z == 999.25 ? 1 : 0) | (z == 999.0 ? 1 : 0) | (z == 9999.0 ? 1 : 0) | (z == 99999.0 ? 1 : 0);
    }
    if (odd != 0)
      clean = false;
  });
  return clean;
}

Survey survey(const Points& points, bool terminators, unsigned threads) {
  constexpr std::size_t grain = 1 << 16;
  std::vector<Survey> parts(points.size() / grain + 1);
  parallelBlocks(points.size(), grain, threads, [&](std::size_t begin, std::size_t end) {
    Survey part;
    for (std::size_t i = begin; i < end; ++i) {
      const double z = points[i].z();
      if (basicKind(points[i], terminators) != Kind::Point || isDoubtful(z))
        continue;
      part.low = std::min(part.low, z);
      part.high = std::max(part.high, z);
    }
    parts[begin / grain] = part;
  });
  Survey all;
  for (const Survey& part : parts) {
    all.low = std::min(all.low, part.low);
    all.high = std::max(all.high, part.high);
  }
  return all;
}

Kind kindOf(const Vector3& p, const Survey& survey, bool terminators) {
  const Kind basic = basicKind(p, terminators);
  const bool known_range = survey.low <= survey.high;
  if (basic != Kind::Point || !isDoubtful(p.z()) || !known_range)
    return basic;
  const double away = std::max(survey.low - p.z(), p.z() - survey.high);
  return away > std::max(survey.high - survey.low, 1.0) ? Kind::NoData : Kind::Point;
}

} // namespace

bool isNullValue(double value) {
  return isNull(value);
}

bool isTerminator(const Vector3& point) {
  return isLineEnd(point);
}

void dropNoData(PickSet& picks, bool terminators, unsigned threads) {
  if (isClean(picks.points, threads))
    return;
  const Survey found = survey(picks.points, terminators, threads);
  std::size_t kept = 0;
  std::size_t ends = 0;
  std::size_t no_data = 0;
  for (std::size_t i = 0; i < picks.points.size(); ++i) {
    const Kind kind = kindOf(picks.points[i], found, terminators);
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
