#include "content/no_data.h"

#include "content/numbers.h"

#include "graben/core/threads.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace graben {
namespace {

constexpr double huge = 1e29;
constexpr std::size_t most_codes = 16;  ///< different nulls in one file
constexpr std::size_t often = 10;       ///< a value is repeated very many times: so often
constexpr double share_of_often = 5e-4; ///< and this share of all
constexpr std::size_t zeros = 3;        ///< so many zeros are no chance

bool same(double value, double code) {
  return std::abs(value - code) <= 1e-7 * std::abs(code); // codes pass through single precision
}

bool isLineEnd(const Vector3& p) {
  return p.x() == 999.0 && p.y() == 999.0 && p.z() == 999.0;
}

/// (0, 0) or twice the same null code.
bool isNullPlace(const Vector3& p) {
  return p.x() == p.y() && isNullCode(p.x());
}

/// The extremes of one coordinate and how many points have exactly them.
struct Extremes {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  std::size_t at_low = 0, at_high = 0, count = 0;

  void add(double value) {
    if (value < low)
      low = value, at_low = 0;
    if (value > high)
      high = value, at_high = 0;
    at_low += value == low ? 1 : 0;
    at_high += value == high ? 1 : 0;
    ++count;
  }
  void add(const Extremes& other) {
    if (other.low <= low) {
      at_low = other.at_low + (other.low == low ? at_low : 0);
      low = other.low;
    }
    if (other.high >= high) {
      at_high = other.at_high + (other.high == high ? at_high : 0);
      high = other.high;
    }
    count += other.count;
  }
};

/// Finds what is null of the z values of a set of points.
class NullFinder {
public:
  NullFinder(const Points& points, const NullRules& rules)
      : points_(points)
      , rules_(rules)
      , nulls_(rules.values) {}

  /// \returns the values that are null; \a odd tells whether any point may have to go
  std::vector<double> find(bool& odd) {
    odd = false;
    Survey found = survey(odd);
    odd |= !nulls_.empty();
    while (rules_.recognise && nulls_.size() < most_codes && found.all.count > 1) {
      const bool high_first = std::abs(found.all.high) >= std::abs(found.all.low);
      if (!take(high_first, found) && !take(!high_first, found))
        break;
      odd = true;
    }
    return nulls_;
  }

private:
  struct Survey {
    Extremes all;
    Extremes without_codes;
  };

  bool isNamed(double z) const {
    return std::any_of(nulls_.begin(), nulls_.end(), [z](double code) { return same(z, code); });
  }

  /// The extremes of z without what is null already and without values like \a except.
  Survey survey(bool& odd, double except = std::numeric_limits<double>::quiet_NaN(), bool with_codes = false) const {
    constexpr std::size_t grain = 1 << 16;
    const std::size_t blocks = points_.size() / grain + 1;
    std::vector<std::pair<Survey, bool>> parts(blocks);
    parallelBlocks(points_.size(), grain, rules_.threads, [&](std::size_t begin, std::size_t end) {
      auto& [extremes, strange] = parts[begin / grain];
      for (std::size_t i = begin; i < end; ++i) {
        const Vector3& p = points_[i];
        const double size = std::max({std::abs(p.x()), std::abs(p.y()), std::abs(p.z())});
        const bool end_of_line = rules_.terminators && isLineEnd(p);
        if (!(size < huge) || end_of_line || std::isnan(p.x()) || std::isnan(p.y()) || std::isnan(p.z())) {
          strange = true;
        } else if (!same(p.z(), except) && !isNamed(p.z())) {
          extremes.all.add(p.z());
          if (with_codes && !isNullCode(p.z()))
            extremes.without_codes.add(p.z());
        }
      }
    });
    Survey all;
    for (const auto& [extremes, strange] : parts) {
      all.all.add(extremes.all);
      all.without_codes.add(extremes.without_codes);
      odd |= strange;
    }
    return all;
  }

  /// Enters the highest or lowest z as null if it is; \a found are then the extremes of the rest.
  bool take(bool high, Survey& found) {
    const double value = high ? found.all.high : found.all.low;
    const std::size_t times = high ? found.all.at_high : found.all.at_low;
    const bool code = isNullCode(value) && (value != 0.0 || times >= zeros);
    const bool repeated = times >= std::max(often, static_cast<std::size_t>(share_of_often * static_cast<double>(found.all.count)));
    if (!code && !repeated)
      return false;
    bool unused = false;
    const Survey left = survey(unused, value, true);
    const Extremes& rest = code ? left.without_codes : left.all;
    if (rest.count == 0)
      return false;
    const double away = high ? value - rest.high : rest.low - value;
    const double range = rest.high - rest.low;
    const double size = std::max(std::abs(rest.high), std::abs(rest.low));
    bool far = away > std::max(range, 1.0);
    if (value == 0.0)
      far = range > 0.0 && away > 4.0 * range;
    else if (!code)
      far = range > 0.0 && away > 10.0 * range && std::abs(value) > 5.0 * size;
    if (!far)
      return false;
    nulls_.push_back(value);
    found = left;
    return true;
  }

  const Points& points_;
  const NullRules& rules_;
  std::vector<double> nulls_;
};

/// Places (0, 0) or of null codes, where all others lie far from them.
bool hasNullPlaces(const Points& points) {
  Extremes x;
  Extremes y;
  std::size_t suspects = 0;
  for (const Vector3& p : points) {
    if (isNullPlace(p)) {
      ++suspects;
      continue;
    }
    if (std::abs(p.x()) < huge && std::abs(p.y()) < huge) {
      x.add(p.x());
      y.add(p.y());
    }
  }
  if (suspects == 0 || x.count < 2)
    return false;
  const auto outside = [](const Extremes& e, double v) { return v < e.low - (e.high - e.low) || v > e.high + (e.high - e.low); };
  return std::all_of(points.begin(), points.end(), [&](const Vector3& p) { return !(isNullPlace(p)) || (outside(x, p.x()) && outside(y, p.y())); });
}

std::string numberText(double value) {
  std::string text;
  appendNumber(text, value);
  return text;
}

void note(PickSet& picks, const NullRules& rules, const std::map<double, std::size_t>& counts, std::size_t no_data, std::size_t ends,
          std::size_t places) {
  std::string values;
  for (const auto& [value, count] : counts) {
    const bool named = std::find(rules.values.begin(), rules.values.end(), value) != rules.values.end();
    if (!named && (value == 0.0 || !isNullCode(value)))
      picks.warnings.push_back("z " + numberText(value) + ", " + std::to_string(count) +
                               " times and far from all other z, is taken for 'no data'; if it is true: --null none");
    values += (values.empty() ? ": z " : ", ") + numberText(value) + " " + std::to_string(count) + " times";
    picks.nulls.push_back({value, count});
  }
  if (no_data > 0)
    picks.notes.push_back(std::to_string(no_data) + " rows without data (null, not finite) dropped" + values);
  if (places > 0)
    picks.notes.push_back(std::to_string(places) + " rows with a null place (x and y both 0 or a null code, far from all others) dropped");
  if (ends > 0)
    picks.notes.push_back(std::to_string(ends) + " rows 999 999 999 (ends of lines) dropped");
}

} // namespace

bool isNullValue(double value) {
  return !(std::abs(value) < huge);
}

bool isNullCode(double value) {
  static constexpr std::array<double, 19> codes = {999.0,    999.25,       999.99,   9999.0,   9999.25,   9999.99,   99999.0,
                                                   99999.99, 99999.9961,   99999.25, 999999.0, 9999900.0, 9999999.0, 32767.0,
                                                   32768.0,  2147483647.0, 1e10,     1e20,     1e15};
  if (value == 0.0)
    return true;
  const double size = std::abs(value);
  return std::any_of(codes.begin(), codes.end(), [size](double code) { return same(size, code); });
}

std::vector<double> nullsOf(const Points& points, const NullRules& rules) {
  bool odd = false;
  return NullFinder(points, rules).find(odd);
}

bool isNullAmong(const std::vector<double>& nulls, double z) {
  return isNullValue(z) || std::any_of(nulls.begin(), nulls.end(), [z](double code) { return same(z, code); });
}

bool isTerminator(const Vector3& point) {
  return isLineEnd(point);
}

void dropNoData(PickSet& picks, const NullRules& rules) {
  bool odd = false;
  const std::vector<double> nulls = NullFinder(picks.points, rules).find(odd);
  const bool places = rules.recognise && hasNullPlaces(picks.points);
  if (!odd && !places)
    return;
  std::size_t kept = 0, ends = 0, no_data = 0, null_places = 0;
  std::map<double, std::size_t> counts;
  for (std::size_t i = 0; i < picks.points.size(); ++i) {
    const Vector3& p = picks.points[i];
    const auto null = std::find_if(nulls.begin(), nulls.end(), [&](double code) { return same(p.z(), code); });
    if (rules.terminators && isLineEnd(p)) {
      ++ends;
    } else if (isNullValue(p.x()) || isNullValue(p.y()) || isNullValue(p.z())) {
      ++no_data;
    } else if (null != nulls.end()) {
      ++no_data;
      ++counts[*null];
    } else if (places && isNullPlace(p)) {
      ++null_places;
    } else {
      if (kept != i) {
        picks.points[kept] = p;
        if (!picks.normals.empty())
          picks.normals[kept] = picks.normals[i];
      }
      ++kept;
    }
  }
  picks.points.resize(kept);
  if (!picks.normals.empty())
    picks.normals.resize(kept);
  picks.no_data_rows += no_data + null_places;
  note(picks, rules, counts, no_data, ends, null_places);
}

} // namespace graben
