// Bundles of triangles for tests: random, hard, and always the same for a seed.
#pragma once

#include <cstdint>

#include "bundle/bundle.h"

namespace twinshade::test {

// splitmix64: small, and the same everywhere.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::uint64_t bits();
  double unit() { return double(bits() >> 11) * 0x1p-53; }
  double between(double a, double b) { return a + (b - a) * unit(); }
  std::uint32_t below(std::uint32_t n) { return std::uint32_t(bits() % n); }

 private:
  std::uint64_t state_;
};

// A bundle without triangles. add_triangle gives it vertices with "v_value" (vec4) and "v_key" (uint).
Bundle empty_bundle(std::uint32_t width, std::uint32_t height);
// Clip-space positions of the frame's own (not the power-of-two) viewport, x y z w each.
void add_triangle(Bundle& bundle, const float (&positions)[12], Random& random);
// To be called once, when all triangles are in.
void finish(Bundle& bundle);

// Random triangles: small, large, slivers, shared vertices, crossing the near plane and the eye plane, huge and far off
// the screen, zero area, reversed, on pixel centres.
Bundle torture_bundle(std::uint32_t width, std::uint32_t height, int triangles, std::uint64_t seed);

// All within the view volume: nothing is clipped.
Bundle inside_bundle(std::uint32_t width, std::uint32_t height, int triangles, std::uint64_t seed);

}  // namespace twinshade::test
