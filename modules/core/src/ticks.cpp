#include "graben/core/ticks.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace graben {

double roundDown125(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double step : {5.0, 2.0})
    if (value >= step * power * (1.0 - 1e-12))
      return step * power;
  return power;
}

std::vector<double> niceTicks(double low, double high, int count) {
  if (!(high > low) || count < 1)
    return {low};
  double step = roundDown125((high - low) / count);
  while ((high - low) / step > count)
    step = roundDown125(step * 2.5);
  std::vector<double> ticks;
  for (double i = std::ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; i += 1.0)
    ticks.push_back(i == 0.0 ? 0.0 : i * step);
  return ticks.empty() ? std::vector<double>{low} : ticks;
}

std::string tickText(double value, double step) {
  const int digits = step > 0.0 ? std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, 12) : 3;
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", digits, value);
  return text;
}

} // namespace graben
