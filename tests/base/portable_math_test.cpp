// Every function against the C library's long double (64 bits of mantissa or more), and its special values.
#include "base/portable_math.h"

#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <random>
#include <string>

#include "base/hash.h"

namespace {

using namespace twinshade;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::string hex(double x) {
  char text[40];
  std::snprintf(text, sizeof text, "%a", x);
  return text;
}

// Relative error of `got` in units of 1e-15, relative to max(|expected|, floor).
double error(double got, long double expected, long double floor) {
  const long double scale = std::max(std::fabs(expected), floor);
  return double(std::fabs(got - expected) / scale * 1e15L);
}

// Worst error of f against reference over `count` arguments drawn by `draw`.
template <class F, class R, class D>
void sweep(const char* name, F f, R reference, D draw, long double floor, double limit = 0.4, int count = 400000) {
  std::mt19937_64 random(7);
  double worst = 0, worst_at = 0;
  for (int i = 0; i < count; ++i) {
    const double x = draw(random);
    const double e = error(f(x), reference((long double)x), floor);
    if (!(e <= worst)) worst = e, worst_at = x;
  }
  INFO(name << ": worst relative error " << worst << "e-15 at " << hex(worst_at) << ", got " << hex(f(worst_at))
            << ", expected " << hex(double(reference((long double)worst_at))));
  CHECK(worst <= limit);
}

auto uniform(double low, double high) {
  return [=](std::mt19937_64& random) { return low + (high - low) * double(random() >> 11) * 0x1p-53; };
}

// Any finite positive double, normal or not.
double any_positive(std::mt19937_64& random) { return std::bit_cast<double>(random() % 0x7ff0000000000000ull); }

}  // namespace

// Measured: at most .37e-15; the limit of the header is 1e-15.
TEST_CASE("portable functions agree with long double libm") {
  using L = long double;
  sweep(
      "sin", portable::sin, [](L x) { return std::sin(x); }, uniform(-10, 10), 0x1p-40L);
  sweep(
      "sin large", portable::sin, [](L x) { return std::sin(x); }, uniform(-0x1p30, 0x1p30), 0x1p-30L);
  sweep(
      "sin small", portable::sin, [](L x) { return std::sin(x); }, uniform(-1e-5, 1e-5), 0);
  sweep(
      "cos", portable::cos, [](L x) { return std::cos(x); }, uniform(-10, 10), 0x1p-40L);
  sweep(
      "cos large", portable::cos, [](L x) { return std::cos(x); }, uniform(-0x1p30, 0x1p30), 0x1p-30L);
  sweep(
      "tan", portable::tan, [](L x) { return std::tan(x); }, uniform(-10, 10), 0x1p-40L);
  sweep(
      "exp2", portable::exp2, [](L x) { return std::exp2(x); }, uniform(-1021, 1023), 0);
  sweep(
      "exp2 near 0", portable::exp2, [](L x) { return std::exp2(x); }, uniform(-1, 1), 0);
  sweep(
      "exp2 denormal", portable::exp2, [](L x) { return std::exp2(x); }, uniform(-1076, -1022), 0x1p-1022L);
  sweep(
      "exp", portable::exp, [](L x) { return std::exp(x); }, uniform(-708, 709), 0);
  sweep(
      "log2", portable::log2, [](L x) { return std::log2(x); }, any_positive, 0);
  sweep(
      "log2 near 1", portable::log2, [](L x) { return std::log2(x); }, uniform(0.5, 2), 0);
  sweep(
      "log", portable::log, [](L x) { return std::log(x); }, any_positive, 0);
  sweep(
      "log near 1", portable::log, [](L x) { return std::log(x); }, uniform(0.999, 1.001), 0);
  sweep(
      "acos", portable::acos, [](L x) { return std::acos(x); }, uniform(-1, 1), 0);
  sweep(
      "acos near 1", portable::acos, [](L x) { return std::acos(x); }, uniform(0.9999, 1), 0);
  sweep(
      "asin", portable::asin, [](L x) { return std::asin(x); }, uniform(-1, 1), 0);
  for (double y : {-400.5, -3.7, -1.0 / 3, 0.01, 0.5, 1 / 2.4, 2.2, 2.4, 7.0, 400.25})
    sweep(
        "pow", [=](double x) { return portable::pow(x, y); }, [=](L x) { return std::pow(x, (L)y); }, uniform(0.2, 4.9),
        0x1p-1022L, 0.4, 40000);
  sweep(
      "pow of 1.4142", [](double y) { return portable::pow(1.4142, y); }, [](L y) { return std::pow((L)1.4142, y); },
      uniform(-2040, 2040), 0x1p-1022L);
}

TEST_CASE("atan2 agrees with long double libm over all quadrants and magnitudes") {
  std::mt19937_64 random(11);
  double worst = 0;
  for (int i = 0; i < 1000000; ++i) {
    double x, y;
    if (i % 2) {
      x = uniform(-1, 1)(random), y = uniform(-1, 1)(random);
    } else {
      x = any_positive(random) * (random() & 1 ? 1 : -1), y = any_positive(random) * (random() & 1 ? 1 : -1);
    }
    const long double expected = std::atan2((long double)y, (long double)x);
    const double e = error(portable::atan2(y, x), expected, 0x1p-1022L);
    if (e > worst) {
      worst = e;
      INFO("atan2(" << hex(y) << ", " << hex(x) << ")");
      REQUIRE(e <= 0.4);
    }
  }
}

TEST_CASE("special values are those of the C library") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(portable::log2(0) == -kInfinity);
  CHECK(portable::log2(kInfinity) == kInfinity);
  CHECK(std::isnan(portable::log2(-1)));
  CHECK(portable::log(0) == -kInfinity);
  for (int e = -1074; e <= 1023; ++e) {
    CHECK(portable::log2(std::ldexp(1.0, e)) == e);
    CHECK(portable::exp2(e) == std::ldexp(1.0, e));
  }
  CHECK(portable::exp2(1024) == kInfinity);
  CHECK(portable::exp2(-1100) == 0);
  CHECK(portable::exp2(-kInfinity) == 0);
  CHECK(portable::exp(kInfinity) == kInfinity);
  CHECK(portable::exp(-kInfinity) == 0);
  CHECK(portable::exp(0) == 1);
  CHECK(std::isnan(portable::exp(nan)));
  CHECK(std::isnan(portable::sin(nan)));
  CHECK(std::isnan(portable::cos(kInfinity)));
  CHECK(std::signbit(portable::sin(-0.0)));
  CHECK(portable::cos(0) == 1);
  CHECK(portable::acos(1) == 0);
  CHECK(portable::acos(1.0000001) == 0);
  CHECK(portable::acos(-2) == portable::kPi);
  CHECK(portable::asin(1) == portable::kPi / 2);
  for (double y : {-kInfinity, -2.0, -0.0, 0.0, 3.0, kInfinity})
    for (double x : {-kInfinity, -2.0, -0.0, 0.0, 3.0, kInfinity}) {
      INFO("atan2(" << y << ", " << x << ")");
      const double got = portable::atan2(y, x), expected = std::atan2(y, x);
      CHECK(std::fabs(got - expected) <= 1e-15);
      CHECK(std::signbit(got) == std::signbit(expected));
    }
  for (double x : {0.0, 0.5, 1.0, 2.0, kInfinity})
    for (double y : {-kInfinity, -2.0, 0.0, 0.5, 3.0, kInfinity}) {
      INFO("pow(" << x << ", " << y << ")");
      const double got = portable::pow(x, y), expected = std::pow(x, y);
      CHECK((got == expected || std::fabs(got - expected) <= 1e-15 * expected));
    }
  CHECK(std::isnan(portable::pow(-1, 0.5)));
}

// The bits are a contract: this hash must be the same from every compiler, optimisation level and processor.
TEST_CASE("the bits of a fixed sweep") {
  Sha256 hash;
  std::mt19937_64 random(3);
  for (int i = 0; i < 20000; ++i) {
    const double u = double(random() >> 11) * 0x1p-53, v = double(random() >> 11) * 0x1p-53;
    const double values[] = {portable::sin(20 * u - 10),  portable::cos(1e6 * u), portable::tan(u),
                             portable::exp2(60 * u - 30), portable::exp(u),       portable::log2(u),
                             portable::log(1 + u),        portable::pow(u, v),    portable::atan2(u - 0.5, v - 0.5),
                             portable::acos(2 * u - 1),   portable::asin(u)};
    hash.add(values, sizeof values);
  }
  CHECK(hash.hex() == "a3a2da2f6a23a75a18c17dac0e690aa0f2017c7e7a22137c07c42d42796a978b");
}
