// Emulated halves against what IEEE 754 says, against the processor's own conversions, and in the functions of GLSL.
#include "cpu_shaders/runtime/half_lanes.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <vector>

#include "cpu_shaders/runtime/denormals.h"

using namespace twinshade;

namespace {

using F = Lanes<4>::F;
using Same = Plain<float, 1>;
using H = HalfLanes<F>;

// The value of a half's bits, as IEEE 754 defines it.
double value_of(std::uint32_t half) {
  const double sign = half & 0x8000u ? -1 : 1, mantissa = half & 0x3ffu;
  const int exponent = int(half >> 10 & 31u);
  if (exponent == 31) return mantissa == 0 ? sign * INFINITY : NAN;
  return sign * (exponent == 0 ? std::ldexp(mantissa, -24) : std::ldexp(1024 + mantissa, exponent - 25));
}

float rounded(float x) {
  const float lane = round_to_half(F(x)).lane(3), plain = round_to_half(Same(x)).value();
  CHECK(number::bits<std::uint32_t>(lane) == number::bits<std::uint32_t>(plain));
  return lane;
}

#if defined(__x86_64__)
__attribute__((target("f16c"))) float by_processor(float x) {
  return _mm_cvtss_f32(_mm_cvtph_ps(_mm_cvtps_ph(_mm_set_ss(x), _MM_FROUND_TO_NEAREST_INT)));
}
bool has_f16c() { return __builtin_cpu_supports("avx2"); }
#else
float by_processor(float x) { return static_cast<float>(static_cast<__fp16>(x)); }
bool has_f16c() { return true; }
#endif

}  // namespace

TEST_CASE("every half is itself, and floats between two halves become the nearer one, ties the even one") {
  std::size_t wrong = 0;
  for (std::uint32_t sign : {0u, 0x8000u})
    for (std::uint32_t half = 0; half < 0x7c00u; ++half) {
      const double here = value_of(sign | half);
      wrong += double(rounded(float(here))) != here;
      wrong += std::signbit(rounded(float(here))) != (sign != 0);
      // The next one; after the largest comes what would be 65536, which is infinity.
      const double next = half == 0x7bffu ? (sign ? -65536.0 : 65536.0) : value_of(sign | (half + 1));
      const double next_is = half == 0x7bffu ? (sign ? -INFINITY : INFINITY) : next;
      const auto middle = float((here + next) / 2);  // a float has digits enough
      wrong += double(rounded(middle)) != (half % 2 == 0 ? here : next_is);
      wrong += double(rounded(std::nextafter(middle, float(here)))) != here;
      wrong += double(rounded(std::nextafter(middle, float(next)))) != next_is;
    }
  CHECK(wrong == 0);
  CHECK(std::isnan(rounded(NAN)));
  CHECK(rounded(INFINITY) == INFINITY);
  CHECK(rounded(65519.996f) == 65504);
  CHECK(rounded(65520) == INFINITY);
  CHECK(rounded(0x1p-25f) == 0);
  CHECK(rounded(0x1.8p-25f) == 0x1p-24f);
}

TEST_CASE("floats become the halves that the processor makes of them, with denormals flushed and without") {
  if (!has_f16c()) {
    MESSAGE("skipped: this processor has no conversions of halves");
    return;
  }
  for (const bool flush : {false, true}) {
    const DenormalMode mode(flush);
    std::size_t wrong = 0;
    for (std::uint64_t word = 0; word < 1ull << 32; word += 4 * 1009) {
      float from[4], to[4];
      for (std::uint32_t i = 0; i < 4; ++i) from[i] = number::bits<float>(std::uint32_t(word) + i * 1009);
      round_to_half(F::load(from)).store(to);
      for (int i = 0; i < 4; ++i) {
        const float expected = by_processor(from[i]);
        wrong += std::isnan(from[i]) ? !std::isnan(to[i])
                                     : number::bits<std::uint32_t>(expected) != number::bits<std::uint32_t>(to[i]);
      }
    }
    CHECK(wrong == 0);
  }
}

// By a way of its own: the exact result, in double, rounded once.
TEST_CASE("operations of halves are the exact result rounded once") {
  std::vector<float> halves;
  std::srand(5);
  for (int i = 0; i < 600; ++i) {
    const double value = value_of(std::uint32_t(std::rand()) & 0xffffu);
    if (std::isfinite(value)) halves.push_back(float(value));
  }
  const auto once = [](double exact) {  // a search among all halves
    if (std::fabs(exact) >= 65520) return std::copysign(INFINITY, exact);
    std::uint32_t low = 0, high = 0x7bffu;
    while (low < high) {
      const std::uint32_t middle = (low + high + 1) / 2;
      if (value_of(middle) <= std::fabs(exact))
        low = middle;
      else
        high = middle - 1;
    }
    const double below = value_of(low), above = low == 0x7bffu ? 65536 : value_of(low + 1);
    const double down = std::fabs(exact) - below, up = above - std::fabs(exact);
    return std::copysign(down < up || (down == up && low % 2 == 0) ? below : above, exact);
  };
  std::size_t wrong = 0;
  for (const float a : halves)
    for (const float b : halves) {
      const H x{F(a)}, y{F(b)};
      wrong += double((x + y).lane(0)) != once(double(a) + b) && double(a) + b != 0;
      wrong += double((x - y).lane(1)) != once(double(a) - b) && double(a) - b != 0;
      wrong += double((x * y).lane(2)) != once(double(a) * b);
      if (b != 0) wrong += double((x / y).lane(3)) != once(double(a) / b);
    }
  for (const float a : halves)
    if (a >= 0) wrong += double(lanes_sqrt(H(F(a))).lane(0)) != once(std::sqrt(double(a)));
  CHECK(wrong == 0);
}

TEST_CASE("functions of GLSL in half have every step in half") {
  const auto constant = [](float x) { return Same(x); };
  using V = vec<F, 3>;
  const V long_one(F(300.0f), F(0.0f), F(0.0f));
  const auto length = [](const auto&... x) { return glsl::length(x...); };
  const auto normalize = [](const auto&... x) { return glsl::normalize(x...); };
  CHECK(in_half(length, long_one).lane(0) == INFINITY);  // 90000 is no half
  CHECK(in_half(normalize, long_one).x.lane(0) == 0);
  CHECK(in_half([](const auto&... x) { return glsl::dot(x...); }, V(F(1.0f), F(2048.0f), F(1.0f)),
                V(F(1.0f), F(1.0f), F(1.0f)))
            .lane(0) == 2048);  // a sum of floats is 2050
  CHECK(in_half([](const auto&... x) { return glsl::mix(x...); }, F(0.0f), constant(1.0f), constant(0.1f)).lane(2) ==
        rounded(0.1f));
  CHECK(in_half([](const auto&... x) { return glsl::sin(x...); }, F(1.0f)).lane(0) == rounded(std::sin(1.0f)));
  CHECK(in_half([](const auto& x, const auto& y) { return x < y; }, F(0.1f), constant(0.100001f)).lane(0) == false);
  CHECK(in_half([](const auto&... x) { return glsl::step(x...); }, constant(0.5f), F(0.25f)).lane(0) == 0);
  CHECK(in_half([](const auto&... x) { return glsl::smoothstep(x...); }, constant(0.0f), constant(1.0f), F(0.5f))
            .lane(0) == 0.5f);
  CHECK(in_half([](const auto&... x) { return glsl::refract(x...); }, V(F(0.0f), F(-1.0f), F(0.0f)),
                V(F(0.0f), F(1.0f), F(0.0f)), constant(0.5f))
            .y.lane(0) == -1);
  using M = mat<Same, 2, 2>;
  const M m(vec<Same, 2>(constant(3), constant(0)), vec<Same, 2>(constant(0), constant(4)));
  const auto inverse = in_half([](const auto&... x) { return glsl::inverse(x...); }, m);
  CHECK(inverse.c[0].x.value() == rounded(1 / 3.0f));
  CHECK(in_half([](const auto& x, const auto& y) { return x * y; }, m, vec<F, 2>(F(0.1f), F(1.0f))).x.lane(0) ==
        rounded(3 * rounded(0.1f)));
  const arr<F, 2> list{{F(0.1f), F(70000.0f)}};
  CHECK(to_half(list).e[1].lane(0) == INFINITY);
  CHECK(to_half(vec<Lanes<4>::I, 2>(Lanes<4>::I(70001), Lanes<4>::I(1))).x.lane(0) == 70001);
}
