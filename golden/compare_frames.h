// Two frames, bit by bit, in layers: coverage, primitive id, depth, attributes, colour. The first layer that differs is
// where to look.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "raster/renderer.h"

namespace twinshade {

struct Difference {
  std::string layer;           // "coverage", "id", "depth", "attributes", "color"
  std::uint32_t x = 0, y = 0;  // pixel, y upwards
  std::uint32_t component = 0;
  Scalar scalar = Scalar::f32;  // of the values
  double a = 0, b = 0;          // values, exactly
  std::uint32_t a_bits = 0, b_bits = 0;
  // Distance in representable floats, or between integers; UINT64_MAX where one is NaN or for ids and coverage.
  std::uint64_t ulp = 0;
  struct Input {
    std::string name;
    Scalar scalar;
    std::uint32_t bits;
  };
  std::vector<Input> inputs;  // the shader's inputs at the pixel, where captured
};

struct Comparison {
  std::uint64_t shaded_pixels = 0;  // covered in a or b
  std::uint64_t coverage_differs = 0, id_differs = 0, depth_differs = 0, attributes_differ = 0;
  std::uint64_t pixels_differ = 0;  // pixels in which any of the compared bits differ
  std::uint64_t denormal_only =
      0;  // of those, pixels where every difference has a denormal on one side and zero on the other
  std::uint64_t max_ulp = 0;  // of colour, over pixels covered with the same id in both; NaN of floats is one class
  std::vector<std::uint64_t> ulp_histogram;  // [0]: equal values, [k]: distance in [2^(k-1), 2^k)
  std::optional<Difference> first;           // of the first layer that differs, in reading order from the top left
  std::vector<Difference> worst;             // up to 8 of that layer, largest ULP first
  bool equal() const { return pixels_differ == 0; }
};

enum class CompareScope { all, shaded_by_a };  // shaded_by_a: colour only, where a covers (softpipe)
Comparison compare_frames(const Frame& a, const Frame& b, CompareScope scope = CompareScope::all);

// Whether two frames have the same coverage and primitives, and depths and colours that are at most `ulp` apart.
// Integers have to be equal, and NaN is near NaN alone.
bool within_ulp(const Frame& a, const Frame& b, std::uint64_t ulp);

// A value's bits as a number, exactly.
double value_of(Scalar scalar, std::uint32_t bits);

// Whether two values are one to a comparison: their bits are, or both are NaNs of floats, whose payload is the
// processor's choice.
bool same_value(Scalar scalar, float a, float b);

// Distance of two values' bits: ulp_distance of floats, between integers their difference.
std::uint64_t value_distance(Scalar scalar, float a, float b);

// Distance in ULP; +0 and -0 are 0 apart for this count but are different bits. UINT64_MAX if exactly one is NaN.
std::uint64_t ulp_distance(float a, float b);

}  // namespace twinshade
