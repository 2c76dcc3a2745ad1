// The irradiance signals that hemispherical bases are measured on (Habel and Wimmer, Efficient Irradiance Normal
// Mapping, I3D 2010, section 5): impulses of light from the upper hemisphere, E(n) = sum of w max(0, n . w), and random
// radiance in spherical harmonics.
#pragma once

#include <cstdint>

#include "experiments/bases.h"

namespace twinshade {

// A block of signals, one column each.
struct SignalBlock {
  Matrix irradiance;         // [point][signal]
  Matrix radiance;           // [25][signal]: its real SH, l <= 4
  std::vector<double> flat;  // irradiance at the normal (0, 0, 1)
};

// S2: 16 impulses of directions uniform on the upper hemisphere and weights of Exp(1). S3: radiance SH l <= 4, iid N(0,
// 1), its irradiance over pi. Signal `first + k` is the same whatever block it is in.
enum class SignalKind { impulses, harmonics };
SignalBlock random_signals(SignalKind kind, std::uint64_t seed, std::size_t first, std::size_t count,
                           const std::vector<glm::dvec3>& points, const Matrix& radiance_at_points);

// One unit impulse, elevation degrees above the horizon, from the +x side.
SignalBlock sun_signal(double elevation, const std::vector<glm::dvec3>& points);

// Unit impulses, each with quadrature points of where it lights the hemisphere: the lune between the horizons of the
// surface and of the light, where irradiance is smooth.
struct Impulses {
  std::vector<glm::dvec3> directions;
  std::vector<double> weights;        // of each impulse; their sum is 1
  std::vector<glm::dvec3> points;     // points_each for each impulse
  std::vector<double> point_weights;  // solid angle
  std::vector<double> irradiance;     // at the point
  std::size_t points_each = 0;
};

// Directions uniform on the upper hemisphere, by quadrature.
Impulses uniform_impulses();
// At one elevation above the horizon, in degrees, from all around.
Impulses impulses_at_elevation(double degrees);
// The one of sun_signal.
Impulses sun_impulse(double degrees);

}  // namespace twinshade
