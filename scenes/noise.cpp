// Value noise with Perlin's quintic fade (K. Perlin, Improving noise, 2002); bits mixed by the finaliser of SplitMix64
// (G. Steele, D. Lea, C. Flood, Fast splittable pseudorandom number generators, 2014).
#include "scenes/noise.h"

#include <cmath>

namespace twinshade {
namespace {

double fade(double t) { return t * t * t * (t * (t * 6 - 15) + 10); }

std::int32_t wrap(std::int32_t i, std::int32_t period) {
  const std::int32_t rest = i % period;
  return rest < 0 ? rest + period : rest;
}

}  // namespace

std::uint32_t lattice_bits(std::int32_t x, std::int32_t y, std::uint32_t seed) {
  std::uint64_t z = (std::uint64_t(std::uint32_t(x)) << 32 | std::uint32_t(y)) + (seed + 1ull) * 0x9e3779b97f4a7c15ull;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
  return std::uint32_t((z ^ (z >> 31)) >> 32);
}

double lattice_random(std::int32_t x, std::int32_t y, std::uint32_t seed) { return lattice_bits(x, y, seed) * 0x1p-32; }

double value_noise(double x, double y, std::int32_t period, std::uint32_t seed) {
  const double x_floor = std::floor(x), y_floor = std::floor(y);
  const std::int32_t x0 = wrap(std::int32_t(x_floor), period), y0 = wrap(std::int32_t(y_floor), period);
  const std::int32_t x1 = wrap(x0 + 1, period), y1 = wrap(y0 + 1, period);
  const double fx = fade(x - x_floor), fy = fade(y - y_floor);
  const double bottom = lattice_random(x0, y0, seed) * (1 - fx) + lattice_random(x1, y0, seed) * fx;
  const double top = lattice_random(x0, y1, seed) * (1 - fx) + lattice_random(x1, y1, seed) * fx;
  return 2 * (bottom * (1 - fy) + top * fy) - 1;
}

double fractal_noise(double x, double y, std::int32_t period, int octaves, std::uint32_t seed) {
  double sum = 0, amplitude = 0.5;
  for (int i = 0; i < octaves; ++i) {
    sum += amplitude * value_noise(x, y, period, seed + std::uint32_t(i));
    amplitude *= 0.5;
    x *= 2;
    y *= 2;
    period *= 2;
  }
  return sum;
}

}  // namespace twinshade
