#include "drawing/contour_labels.h"

#include "graben/core/ticks.h"

#include <algorithm>
#include <cmath>

namespace graben {

namespace {

constexpr double kShortest = 90.0;  // pixels of line that a number wants
constexpr double kApart = 46.0;     // between numbers
constexpr double kFromFault = 26.0; // and from what is to stay free
constexpr double kBetween = 420.0;  // pixels of line between its numbers

} // namespace

double contourStep(double low, double high) {
  const std::vector<double> ticks = niceTicks(low, high, 25);
  return ticks.size() > 1 ? ticks[1] - ticks[0] : std::max(1.0, high - low);
}

void ContourLabels::want(const std::vector<Place>& line, const std::string& text) {
  double length = 0.0;
  for (std::size_t i = 0; i + 1 < line.size(); ++i)
    length += (line[i + 1] - line[i]).norm();
  if (length >= kShortest)
    wishes_.push_back({line, text, length});
}

bool ContourLabels::label(const Wish& wish, double share) {
  double left = share * wish.length;
  std::size_t i = 0;
  while (i + 2 < wish.line.size() && (wish.line[i + 1] - wish.line[i]).norm() < left)
    left -= (wish.line[i + 1] - wish.line[i]).norm(), ++i;
  const Place run = wish.line[i + 1] - wish.line[i];
  const double length = run.norm();
  const Place at = wish.line[i] + (length > 0.0 ? Place(std::min(left / length, 1.0) * run) : Place(0.0, 0.0));
  if (at.x() < frame_.left + 25.0 || at.x() > frame_.right() - 25.0 || at.y() < frame_.top + 14.0 || at.y() > frame_.bottom() - 14.0)
    return false;
  for (std::size_t t = 0; t < taken_.size(); ++t)
    if ((taken_[t] - at).norm() < kFromFault)
      return false;
  // The direction over some pixels: single steps are those of the triangles.
  const std::size_t before = i >= 6 ? i - 6 : 0;
  const std::size_t after = std::min(i + 7, wish.line.size() - 1);
  const Place way = wish.line[after] - wish.line[before];
  double turn = std::atan2(way.y(), way.x());
  if (std::abs(turn) > 1.5707963267948966)
    turn += turn > 0.0 ? -3.141592653589793 : 3.141592653589793;
  TextLook look{13.0};
  look.turn = turn;
  look.halo = true;
  canvas_.text(at, wish.text, look);
  for (const double along : {-0.5, 0.0, 0.5})
    taken_.push_back(at + along * kApart * Place(std::cos(turn), std::sin(turn)));
  return true;
}

void ContourLabels::draw() {
  std::stable_sort(wishes_.begin(), wishes_.end(), [](const Wish& a, const Wish& b) { return a.length > b.length; });
  for (const Wish& wish : wishes_) {
    const int count = std::max(1, static_cast<int>(wish.length / kBetween));
    for (int k = 0; k < count; ++k)
      for (const double shift : {0.0, 0.1, -0.1, 0.2, -0.2, 0.3, -0.3, 0.4, -0.4})
        if (label(wish, (k + 0.5 + shift) / count))
          break;
  }
}

} // namespace graben
