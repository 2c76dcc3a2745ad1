// What docs/exact-functions.md says of zeros, infinities, NaN and the ends of the range.
#include <doctest/doctest.h>

#include <cmath>

#include "tests/exact/transcendental_shader.h"

namespace twinshade::test {
namespace {

constexpr float kInfinity = INFINITY, kNan = NAN, kDenormal = 0x1p-130f;

const RowShader& all_functions() {
  static const RowShader made("transcendental", kTranscendentalShader);
  return made;
}

struct Case {
  Function function;
  float x, y, expected;
};

}  // namespace

TEST_CASE("special values are as documented") {
  constexpr float kPi = 3.14159274f;
  const std::vector<Case> cases = {
      {Function::exp2, kInfinity, 0, kInfinity},
      {Function::exp2, -kInfinity, 0, 0},
      {Function::exp2, 128, 0, kInfinity},
      {Function::exp2, -126, 0, 0x1p-126f},
      {Function::exp2, -126.5f, 0, 0},
      {Function::exp2, 127, 0, 0x1p127f},
      {Function::exp2, kNan, 0, kNan},
      {Function::exp2, -0.0f, 0, 1},
      {Function::exp2, -3e38f, 0, 0},
      {Function::log2, 0, 0, -kInfinity},
      {Function::log2, -0.0f, 0, -kInfinity},
      {Function::log2, -1, 0, kNan},
      {Function::log2, kInfinity, 0, kInfinity},
      {Function::log2, -kInfinity, 0, kNan},
      {Function::log2, kNan, 0, kNan},
      {Function::log2, kDenormal, 0, -kInfinity},
      {Function::log2, -kDenormal, 0, -kInfinity},
      {Function::log2, 1, 0, 0},
      {Function::log2, 0x1p-126f, 0, -126},
      {Function::log2, 0x1p100f, 0, 100},
      {Function::pow, 0, 0, 1},
      {Function::pow, kInfinity, 0, 1},
      {Function::pow, -2, 0, 1},
      {Function::pow, kNan, 0, kNan},
      {Function::pow, 2, kNan, kNan},
      {Function::pow, 0, 2, 0},
      {Function::pow, -0.0f, 2, 0},
      {Function::pow, 0, -2, kInfinity},
      {Function::pow, -1, 2, kNan},
      {Function::pow, kInfinity, 0.5f, kInfinity},
      {Function::pow, kInfinity, -0.5f, 0},
      {Function::pow, 2, kInfinity, kInfinity},
      {Function::pow, 2, -kInfinity, 0},
      {Function::pow, 0.5f, kInfinity, 0},
      {Function::pow, 0.5f, -kInfinity, kInfinity},
      {Function::pow, 1, kInfinity, 1},
      {Function::pow, 1, 3e38f, 1},
      {Function::pow, 2, 128, kInfinity},
      {Function::pow, 2, -126, 0x1p-126f},
      {Function::pow, 2, -127, 0},
      {Function::pow, 7, 1, 7},
      {Function::pow, 3, 4, 81},
      {Function::pow, 0.25f, 0.5f, 0.5f},
      {Function::sin, 0, 0, 0},
      {Function::sin, -0.0f, 0, 0},
      {Function::sin, kInfinity, 0, kNan},
      {Function::sin, -kInfinity, 0, kNan},
      {Function::sin, kNan, 0, kNan},
      {Function::cos, 0, 0, 1},
      {Function::cos, -0.0f, 0, 1},
      {Function::cos, kInfinity, 0, kNan},
      {Function::cos, kNan, 0, kNan},
      {Function::atan2, 0, 0, 0},
      {Function::atan2, -0.0f, 0, -0.0f},
      {Function::atan2, 0, -1, kPi},
      {Function::atan2, -0.0f, -1, -kPi},
      {Function::atan2, 1, 0, 0.5f * kPi},
      {Function::atan2, -1, 0, -0.5f * kPi},
      {Function::atan2, kInfinity, kInfinity, 0.25f * kPi},
      {Function::atan2, -kInfinity, -kInfinity, -2.35619449f},
      {Function::atan2, 1, kInfinity, 0},
      {Function::atan2, kInfinity, 1, 0.5f * kPi},
      {Function::atan2, 1, -kInfinity, kPi},
      {Function::atan2, kNan, 1, kNan},
      {Function::atan2, 1, kNan, kNan},
      {Function::atan2, 3e38f, 3e38f, 0.25f * kPi},
      {Function::atan2, 0x1p-126f, 0x1p-126f, 0.25f * kPi},
      {Function::acos, 1, 0, 0},
      {Function::acos, -1, 0, kPi},
      {Function::acos, 0, 0, 0.5f * kPi},
      {Function::acos, 1.00000012f, 0, kNan},
      {Function::acos, -2, 0, kNan},
      {Function::acos, kNan, 0, kNan},
      {Function::asin, 1, 0, 0.5f * kPi},
      {Function::asin, -1, 0, -0.5f * kPi},
      {Function::asin, 0, 0, 0},
      {Function::asin, 2, 0, kNan},
      {Function::asin, kInfinity, 0, kNan},
      {Function::asin, kNan, 0, kNan},
  };
  for (const Case& c : cases) {
    const float value = evaluate(all_functions(), c.function, {c.x}, {c.y})[0];
    CAPTURE(static_cast<int>(c.function));
    CAPTURE(hex(c.x));
    CAPTURE(hex(c.y));
    CAPTURE(hex(value));
    CAPTURE(hex(c.expected));
    CHECK((bits_of(value) == bits_of(c.expected) || (std::isnan(value) && std::isnan(c.expected))));
  }
}

TEST_CASE("symmetries hold to the last bit") {
  Random random(4);
  std::vector<float> x, y, minus_x;
  for (int i = 0; i < 100000; ++i) {
    x.push_back(i % 2 ? random.uniform(-500, 500) : float_of(random.bits() & 0x7f7fffffu));
    y.push_back(float_of(random.bits()));
    minus_x.push_back(-x.back());
  }
  const auto check_all = [&](Function function, bool odd) {
    const std::vector<float> a = evaluate(all_functions(), function, x, y),
                             b = evaluate(all_functions(), function, minus_x, y);
    int broken = 0;
    for (std::size_t i = 0; i < x.size(); ++i) broken += !(a[i] == (odd ? -b[i] : b[i])) && !std::isnan(a[i]);
    CAPTURE(static_cast<int>(function));
    CHECK(broken == 0);
  };
  check_all(Function::sin, true);
  check_all(Function::cos, false);
  check_all(Function::atan2, true);
  check_all(Function::asin, true);
}

}  // namespace twinshade::test
