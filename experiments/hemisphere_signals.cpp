#include "experiments/hemisphere_signals.h"

#include <cmath>

#include "base/portable_math.h"
#include "lighting/direction_sets.h"
#include "lighting/quadrature.h"
#include "lighting/radiance_basis.h"
#include "lighting/random.h"

namespace twinshade {
namespace {

using portable::kPi;

constexpr int kImpulsesPerSignal = 16;
constexpr int kElevations = 24, kAzimuths = 9, kAcross = 24, kAlong = 24;

// Domains of random_bits.
enum Stream : std::uint64_t { direction_stream = 1, azimuth_stream, weight_stream, radius_stream, angle_stream };

// (0, 1], so that its logarithm is finite.
double positive_unit_real(std::uint64_t bits) { return 1 - unit_real(bits); }

// Box and Muller, A note on the generation of random normal deviates, 1958.
double normal_deviate(std::uint64_t seed, std::uint64_t signal, std::uint64_t k) {
  const double radius = std::sqrt(-2 * portable::log(positive_unit_real(random_bits(seed, radius_stream, signal, k))));
  return radius * portable::cos(2 * kPi * unit_real(random_bits(seed, angle_stream, signal, k)));
}

// On [0, 1].
struct LineQuadrature {
  std::vector<double> nodes, weights;
};

// Gauss-Legendre in t with x = sin^2(pi t / 2): square roots at both ends become smooth. A ring of sphere_quadrature is
// a node: its height, and its weight over all azimuths.
LineQuadrature root_safe_line(int points) {
  const Quadrature rings = sphere_quadrature(0, points);
  LineQuadrature line;
  for (int ring = 0; ring < points; ++ring) {
    const std::size_t first = std::size_t(ring) * 2 * std::size_t(points);
    const double t = rings.directions[first].z, s = portable::sin(kPi * t / 2);
    line.nodes.push_back(s * s);
    line.weights.push_back(rings.weights[first] * points / kPi * (kPi / 2 * portable::sin(kPi * t)));
  }
  return line;
}

// Adds an impulse (radians). In the lune n = cos(psi) a + sin(psi) (cos(beta) h + sin(beta) z), with a horizontal, h
// the horizontal part of the light's direction and z up: psi in (0, pi), beta in (0, pi/2 + elevation).
void add_impulse(Impulses& impulses, double elevation, double azimuth, double weight) {
  static const LineQuadrature across = root_safe_line(kAcross), along = root_safe_line(kAlong);
  const double widest = kPi / 2 + elevation;
  const double sine = portable::sin(elevation), cosine = portable::cos(elevation);
  const glm::dvec3 h(portable::cos(azimuth), portable::sin(azimuth), 0), a(-h.y, h.x, 0), up(0, 0, 1);
  const glm::dvec3 light = h * cosine + up * sine;
  impulses.directions.push_back(light);
  impulses.weights.push_back(weight);
  for (int i = 0; i < kAlong; ++i)
    for (int k = 0; k < kAcross; ++k) {
      const double psi = kPi * along.nodes[i], beta = widest * across.nodes[k];
      const double sin_psi = portable::sin(psi);
      const glm::dvec3 n = a * portable::cos(psi) + (h * portable::cos(beta) + up * portable::sin(beta)) * sin_psi;
      impulses.points.push_back(n);
      impulses.point_weights.push_back(along.weights[i] * kPi * across.weights[k] * widest * sin_psi);
      impulses.irradiance.push_back(glm::dot(n, light));
    }
  impulses.points_each = std::size_t(kAcross) * kAlong;
}

// The same from kAzimuths sides, of `weight` together.
void add_impulses(Impulses& impulses, double elevation, double weight) {
  for (int k = 0; k < kAzimuths; ++k)
    add_impulse(impulses, elevation, 2 * kPi * (k + 0.5) / kAzimuths, weight / kAzimuths);
}

}  // namespace

SignalBlock random_signals(SignalKind kind, std::uint64_t seed, std::size_t first, std::size_t count,
                           const std::vector<glm::dvec3>& points, const Matrix& radiance_at_points) {
  SignalBlock block;
  block.irradiance = Matrix::Zero(Eigen::Index(points.size()), Eigen::Index(count));
  block.radiance = Matrix::Zero(kRadianceCount, Eigen::Index(count));
  block.flat.assign(count, 0);

  if (kind == SignalKind::impulses) {
    std::vector<glm::dvec3> lights(kImpulsesPerSignal * count);
    std::vector<double> weights(lights.size());
    for (std::size_t s = 0; s < count; ++s)
      for (std::size_t k = 0; k < kImpulsesPerSignal; ++k) {
        const std::size_t i = s * kImpulsesPerSignal + k;
        lights[i] = hemisphere_direction(unit_real(random_bits(seed, direction_stream, first + s, k)),
                                         unit_real(random_bits(seed, azimuth_stream, first + s, k)));
        weights[i] = -portable::log(positive_unit_real(random_bits(seed, weight_stream, first + s, k)));
      }
    const std::vector<double> values = radiance_basis(lights);
    for (std::size_t i = 0; i < lights.size(); ++i) {
      const Eigen::Index s = Eigen::Index(i / kImpulsesPerSignal);
      for (int j = 0; j < kRadianceCount; ++j)
        block.radiance(j, s) += weights[i] * values[i * kRadianceCount + std::size_t(j)];
      block.flat[std::size_t(s)] += weights[i] * lights[i].z;
      for (std::size_t p = 0; p < points.size(); ++p)
        block.irradiance(Eigen::Index(p), s) += weights[i] * std::max(0.0, glm::dot(points[p], lights[i]));
    }
    return block;
  }

  const auto cosine = clamped_cosine_factors();
  const glm::dvec3 normal(0, 0, 1);
  const std::vector<double> at_normal = radiance_basis({&normal, 1});
  for (Eigen::Index s = 0; s < Eigen::Index(count); ++s)
    for (int j = 0; j < kRadianceCount; ++j) {
      block.radiance(j, s) = normal_deviate(seed, first + std::size_t(s), std::uint64_t(j)) / kPi;
      block.flat[std::size_t(s)] += block.radiance(j, s) * cosine[std::size_t(j)] * at_normal[std::size_t(j)];
    }
  for (Eigen::Index p = 0; p < Eigen::Index(points.size()); ++p)
    for (int j = 0; j < kRadianceCount; ++j) {
      const double factor = radiance_at_points(p, j) * cosine[std::size_t(j)];
      for (Eigen::Index s = 0; s < Eigen::Index(count); ++s) block.irradiance(p, s) += factor * block.radiance(j, s);
    }
  return block;
}

SignalBlock sun_signal(double elevation, const std::vector<glm::dvec3>& points) {
  const double angle = elevation * kPi / 180;
  const glm::dvec3 light(portable::cos(angle), 0, portable::sin(angle));
  SignalBlock block;
  block.irradiance = Matrix(Eigen::Index(points.size()), 1);
  for (std::size_t p = 0; p < points.size(); ++p)
    block.irradiance(Eigen::Index(p), 0) = std::max(0.0, glm::dot(points[p], light));
  const std::vector<double> values = radiance_basis({&light, 1});
  block.radiance = Eigen::Map<const Matrix>(values.data(), kRadianceCount, 1);
  block.flat = {light.z};
  return block;
}

Impulses uniform_impulses() {
  Impulses impulses;
  const LineQuadrature elevations = root_safe_line(kElevations);
  for (int i = 0; i < kElevations; ++i) {
    const double elevation = kPi / 2 * elevations.nodes[i];
    // Share of the hemisphere's solid angle: cos(elevation) d(elevation)
    add_impulses(impulses, elevation, elevations.weights[i] * kPi / 2 * portable::cos(elevation));
  }
  return impulses;
}

Impulses impulses_at_elevation(double degrees) {
  Impulses impulses;
  add_impulses(impulses, degrees * kPi / 180, 1);
  return impulses;
}

Impulses sun_impulse(double degrees) {
  Impulses impulses;
  add_impulse(impulses, degrees * kPi / 180, 0, 1);
  return impulses;
}

}  // namespace twinshade
