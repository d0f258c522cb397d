#pragma once

#include <cmath>

namespace graben::synthetic {

/// Root of \a f in [a, b], where f changes sign (Illinois variant of the false position method,
/// then bisection). Symmetric in the sign of f: f and -f give the same bits.
template <typename Function>
double findRoot(const Function& f, double a, double b) {
  double fa = f(a);
  double fb = f(b);
  if (fa == 0.0)
    return a;
  if (fb == 0.0)
    return b;
  const double enough = 1e-11;
  int last = 0;
  for (int i = 0; i < 300; ++i) {
    const double c = i < 100 ? (fa * b - fb * a) / (fa - fb) : 0.5 * (a + b);
    const double fc = f(c);
    if (std::abs(fc) < enough || c == a || c == b)
      return c;
    if ((fc > 0.0) == (fb > 0.0)) {
      b = c;
      fb = fc;
      if (last == 1)
        fa *= 0.5;
      last = 1;
    } else {
      a = c;
      fa = fc;
      if (last == -1)
        fb *= 0.5;
      last = -1;
    }
  }
  return 0.5 * (a + b);
}

} // namespace graben::synthetic
