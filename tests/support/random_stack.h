#pragma once

#include "support/stacks.h"

#include <cmath>
#include <random>

namespace graben::test {

/// A stack of horizons and faults drawn by lot, in smallBox().
struct RandomStack {
  std::vector<StackHorizon> horizons;
  std::vector<FaultSurface> faults;
  double branch_reach = 0.0;
  BlockModelOptions options;
};

/// Horizons as the earth makes them: a layer between conformable ones is nowhere less than nothing and may pinch out; one that cuts off or ends at
/// another crosses it as it likes. Faults of any strike, dip and length, wherever they fall.
class StackLottery {
public:
  explicit StackLottery(std::uint64_t seed) : random_(seed) {}

  RandomStack draw() {
    RandomStack stack;
    drawHorizons(stack);
    const std::size_t faults = random_() % 5;
    for (std::size_t f = 0; f < faults; ++f)
      stack.faults.push_back(drawFault(f));
    stack.options = smallBox(uniform(18.0, 45.0));
    stack.options.min_thickness = uniform(0.0, 6.0);
    stack.branch_reach = uniform(0.0, 60.0);
    return stack;
  }

private:
  using Height = std::function<double(double, double)>;

  double uniform(double low, double high) { return low + (high - low) * (static_cast<double>(random_() >> 11) * 0x1.0p-53); }

  Height waves(double level, double amplitude) {
    const double a = uniform(0.0, amplitude), u = uniform(40.0, 120.0), v = uniform(40.0, 120.0), slope = uniform(-0.2, 0.2);
    return [=](double x, double y) { return level + a * std::sin(x / u) * std::cos(y / v) + slope * x; };
  }

  void drawHorizons(RandomStack& stack) {
    Height upper = waves(uniform(60.0, 120.0), 25.0);
    const std::size_t count = 1 + random_() % 5;
    for (std::size_t k = 0; k < count; ++k) {
      stack.horizons.push_back({"H" + std::to_string(k), surfaceOver(260.0, 26, upper), static_cast<HorizonRelation>(random_() % 3)});
      const Height thickness = waves(uniform(-10.0, 50.0), 25.0);
      const bool conformable = stack.horizons.back().relation == HorizonRelation::Conformable;
      upper = [upper, thickness, conformable](double x, double y) {
        return upper(x, y) - (conformable ? std::max(0.0, thickness(x, y)) : thickness(x, y));
      };
    }
  }

  FaultSurface drawFault(std::size_t number) {
    const double strike = uniform(0.0, 6.28), before = uniform(-400.0, 0.0), dip = uniform(0.6, 6.0), length = uniform(60.0, 700.0);
    const Vector3 at(uniform(-150, 150), uniform(-150, 150), uniform(-60, 60));
    return planeFault("F" + std::to_string(number), at, {std::cos(strike), std::sin(strike)}, dip, before, before + length);
  }

  std::mt19937_64 random_;
};

} // namespace graben::test
