#include <doctest/doctest.h>

#include <cmath>

#include "lighting/texel_storage.h"

namespace twinshade {

TEST_CASE("every half is its own nearest half, and ties go to even") {
  for (int bits = 0; bits < 0x7c00; ++bits) {
    const int exponent = bits >> 10, mantissa = bits & 1023;
    const double value = exponent == 0 ? std::ldexp(mantissa, -24) : std::ldexp(1024 + mantissa, exponent - 25);
    REQUIRE(double(round_to_half(value)) == value);
    REQUIRE(double(round_to_half(-value)) == -value);
    const double step = std::ldexp(1, (exponent == 0 ? 1 : exponent) - 25);
    const double even = bits % 2 == 0 ? value : value + step;
    if (bits + 1 < 0x7c00) REQUIRE(double(round_to_half(value + step / 2)) == even);
    REQUIRE(double(round_to_half(value + step * 0.499)) == value);
  }
  CHECK(round_to_half(65519.99) == 65504.0f);
  CHECK(std::isinf(round_to_half(65520)));
  CHECK(std::isnan(round_to_half(std::nan(""))));
}

TEST_CASE("eight bits hold the ends of a column's range and err by half a step in between") {
  const std::vector<double> values = {-1, 5, 0.3, 5, 2, 5};  // two columns
  const std::vector<float> stored = through_storage(values, 2, TexelStorage::unorm8);
  CHECK(stored[0] == -1.0f);
  CHECK(stored[4] == 2.0f);
  CHECK(std::fabs(stored[2] - 0.3) <= 3.0 / 255 / 2 + 1e-6);
  for (const int constant : {1, 3, 5}) CHECK(stored[std::size_t(constant)] == 5.0f);
}

}  // namespace twinshade
