// Repeatable randomness from integers: the same on every machine, and every value can be asked for alone.
#pragma once

#include <cstdint>

namespace twinshade {

// Well mixed bits of a lattice point and a seed.
std::uint32_t lattice_bits(std::int32_t x, std::int32_t y, std::uint32_t seed);
// The same as a number in [0, 1).
double lattice_random(std::int32_t x, std::int32_t y, std::uint32_t seed);

// Smooth noise in [-1, 1] over the plane, one value per unit square, repeating after `period` squares in x and y.
double value_noise(double x, double y, std::int32_t period, std::uint32_t seed);
// Sum of `octaves` of value_noise, each at twice the frequency and half the amplitude; repeats after `period`.
double fractal_noise(double x, double y, std::int32_t period, int octaves, std::uint32_t seed);

// Numbers in a row, for generators. Draw each in its own statement or in a braced list: the arguments of a call are
// evaluated in any order.
class Random {
 public:
  explicit Random(std::uint32_t seed) : seed_(seed) {}
  std::uint32_t bits() { return lattice_bits(std::int32_t(count_++), 0, seed_); }
  double uniform() { return bits() * 0x1p-32; }                                       // [0, 1)
  double between(double low, double high) { return low + (high - low) * uniform(); }  // [low, high)
  std::uint32_t below(std::uint32_t n) { return std::uint32_t((std::uint64_t(bits()) * n) >> 32); }

 private:
  std::uint32_t seed_, count_ = 0;
};

}  // namespace twinshade
