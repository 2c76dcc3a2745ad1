// Nodes by Newton's method on the Legendre polynomial from Tricomi's first guess (Davis and Rabinowitz, Methods of
// Numerical Integration, section 2.7).
#include "lighting/quadrature.h"

#include <cmath>

#include "base/portable_math.h"

namespace twinshade {

Quadrature sphere_quadrature(double z_low, int rings) {
  const int spokes = 2 * rings;
  Quadrature out;
  for (int ring = 0; ring < rings; ++ring) {
    double x = portable::cos(portable::kPi * (ring + 0.75) / (rings + 0.5)), slope = 0;
    for (int step = 0; step < 8; ++step) {
      double before = 1, value = x;  // P_0, P_1
      for (int k = 2; k <= rings; ++k) {
        const double after = ((2 * k - 1) * x * value - (k - 1) * before) / k;
        before = value;
        value = after;
      }
      slope = rings * (x * value - before) / (x * x - 1);
      x -= value / slope;
    }
    const double half = (1 - z_low) / 2, z = z_low + half * (x + 1);
    const double weight = half * 2 / ((1 - x * x) * slope * slope) * 2 * portable::kPi / spokes;
    const double radius = std::sqrt(1 - z * z);
    for (int spoke = 0; spoke < spokes; ++spoke) {
      const double angle = 2 * portable::kPi * (spoke + 0.5) / spokes;
      out.directions.push_back({radius * portable::cos(angle), radius * portable::sin(angle), z});
      out.weights.push_back(weight);
    }
  }
  return out;
}

}  // namespace twinshade
