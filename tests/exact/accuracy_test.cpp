// The worst error of each transcendental function, swept over floats, against the figures in docs/exact-functions.md.
#include <doctest/doctest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "tests/exact/transcendental_shader.h"

namespace twinshade::test {
namespace {

constexpr std::uint32_t kInfinityBits = 0x7f800000;

const RowShader& shader() {
  static const RowShader made("transcendental", kTranscendentalShader);
  return made;
}

// Denormal arguments are zeros of their sign, as shaders have it.
long double flushed(float x) { return std::fabs(x) < 0x1p-126f ? std::copysign(0.0L, x) : static_cast<long double>(x); }

long double exact(Function function, float x, float y) {
  switch (function) {
    case Function::exp2:
      return std::exp2(flushed(x));
    case Function::log2:
      return flushed(x) == 0 ? -HUGE_VALL : std::log2(flushed(x));
    case Function::pow:
      return std::pow(flushed(x), flushed(y));
    case Function::sin:
      return std::sin(flushed(x));
    case Function::cos:
      return std::cos(flushed(x));
    case Function::atan2:
      return flushed(x) == 0 && flushed(y) == 0 ? flushed(x) : std::atan2(flushed(x), flushed(y));
    case Function::acos:
      return std::acos(flushed(x));
    case Function::asin:
      return std::asin(flushed(x));
    case Function::exp:
      return std::exp(flushed(x));
    case Function::log:
      return flushed(x) == 0 ? -HUGE_VALL : std::log(flushed(x));
    case Function::tan:
      return std::tan(flushed(x));
    case Function::sinh:
      return std::sinh(flushed(x));
    case Function::cosh:
      return std::cosh(flushed(x));
    case Function::tanh:
      return std::tanh(flushed(x));
  }
  return 0;
}

struct Worst {
  double ulp = 0;
  float x = 0, y = 0, value = 0;
};

Worst worst_of(Function function, const std::vector<float>& x, const std::vector<float>& y) {
  const std::vector<float> values = evaluate(shader(), function, x, y);
  Worst worst;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double ulp = ulp_error(values[i], exact(function, x[i], y[i]));
    if (ulp > worst.ulp) worst = {ulp, x[i], y[i], values[i]};
  }
  return worst;
}

// Every step-th float between two magnitudes, of both signs.
std::vector<float> floats_between(float low, float high, std::uint32_t step) {
  std::vector<float> list;
  for (std::uint32_t bits = bits_of(low); bits <= bits_of(high); bits += step) {
    list.push_back(float_of(bits));
    list.push_back(float_of(bits | 0x80000000u));
  }
  return list;
}

// Rows of the table in docs/exact-functions.md: (function, inputs) -> worst ULP.
std::map<std::pair<std::string, std::string>, double> recorded_figures() {
  std::map<std::pair<std::string, std::string>, double> figures;
  std::ifstream file(TWINSHADE_SOURCE_DIR "/docs/exact-functions.md");
  for (std::string line; std::getline(file, line);) {
    std::istringstream cells(line);
    std::string empty, function, inputs, figure;
    if (!std::getline(cells, empty, '|') || !std::getline(cells, function, '|') || !std::getline(cells, inputs, '|') ||
        !std::getline(cells, figure, '|'))
      continue;
    std::istringstream number(figure);
    double value = 0;
    if (number >> value && number.peek() == ' ')
      figures[{function.substr(2, function.size() - 4), inputs.substr(1, inputs.size() - 2)}] = value;
  }
  return figures;
}

void check(Function function, const std::string& name, const std::string& inputs, const std::vector<float>& x,
           const std::vector<float>& y) {
  const auto figures = recorded_figures();
  const auto figure = figures.find({name, inputs});
  REQUIRE_MESSAGE(figure != figures.end(), "docs/exact-functions.md has no row for ", name, ", ", inputs);
  const Worst worst = worst_of(function, x, y);
  CAPTURE(hex(worst.x));
  CAPTURE(hex(worst.y));
  CAPTURE(hex(worst.value));
  CHECK(worst.ulp <= figure->second);
  CHECK(worst.ulp >= figure->second - 0.5);  // the figure is what happens, not a loose bound
  MESSAGE(name, " ", inputs, ": ", worst.ulp, " ULP over ", x.size(), " inputs");
}

void check(Function function, const std::string& name, const std::string& inputs, const std::vector<float>& x) {
  check(function, name, inputs, x, x);
}

}  // namespace

// Steps are odd, so that every low bit of the significand varies.

TEST_CASE("exp2 is as accurate as documented") {
  std::vector<float> x = floats_between(0.0f, float_of(kInfinityBits), 1801);
  for (const float more : floats_between(0x1p-6f, 130.0f, 211)) x.push_back(more);
  check(Function::exp2, "exact_exp2", "every fifth float", x);
}

TEST_CASE("log2 is as accurate as documented, near 1 too") {
  std::vector<float> x = floats_between(0.0f, float_of(kInfinityBits), 1801);
  for (const float more : floats_between(0.5f, 2.0f, 33)) x.push_back(more);
  check(Function::log2, "exact_log2", "every fifth float, every float in [1/2, 2]", x);
}

TEST_CASE("sin and cos are as accurate as documented, near multiples of pi too") {
  std::vector<float> small = floats_between(0x1p-126f, 399.99997f, 1801),
                     large = floats_between(400.0f, float_of(kInfinityBits), 1201);
  for (const float more : floats_between(0.25f, 399.99997f, 331)) small.push_back(more);
  for (int k = 1; k < 250; ++k)
    for (int around = -8; around <= 8; ++around)
      small.push_back(
          float_of(bits_of(static_cast<float>(k * 1.57079632679489661923)) + static_cast<std::uint32_t>(around)));
  check(Function::sin, "exact_sin", "every fifth float below 400", small);
  check(Function::cos, "exact_cos", "every fifth float below 400", small);
  check(Function::sin, "exact_sin", "every fifth float from 400", large);
  check(Function::cos, "exact_cos", "every fifth float from 400", large);
}

TEST_CASE("acos and asin are as accurate as documented") {
  std::vector<float> x = floats_between(0x1p-126f, 1.0f, 2003);
  for (const float more : floats_between(0x1p-4f, 1.0f, 101)) x.push_back(more);
  check(Function::acos, "exact_acos", "every float in [-1, 1]", x);
  check(Function::asin, "exact_asin", "every float in [-1, 1]", x);
}

TEST_CASE("atan2 is as accurate as documented") {
  Random random(1);
  std::vector<float> y, x;
  for (int i = 0; i < 1500000; ++i) {
    y.push_back(float_of(random.bits()));
    // the other argument: any float, or one of the same binade
    x.push_back(float_of(i % 2 ? random.bits() : (bits_of(y.back()) & 0x7f800000u) | (random.bits() & 0x807fffffu)));
  }
  check(Function::atan2, "exact_atan2", "60 million pairs of all floats, half of them within one binade", y, x);
}

TEST_CASE("pow is as accurate as documented up to the ends of the range") {
  Random random(2);
  std::vector<float> x, y;
  while (x.size() < 1500000) {
    const float base = x.size() % 2 ? float_of(random.bits() & 0x7fffffffu) : random.uniform(0.5f, 2.0f);
    const long double logarithm = std::log2(static_cast<long double>(base));
    if (!std::isfinite(logarithm) || logarithm == 0) continue;
    x.push_back(base);
    y.push_back(static_cast<float>(random.uniform(-130, 130) / logarithm));
  }
  check(Function::pow, "exact_pow", "60 million pairs with a result in range", x, y);
}

TEST_CASE("exp, log, tan and the hyperbolic functions are as accurate as documented") {
  std::vector<float> x = floats_between(0x1p-30f, 80.0f, 4001);
  check(Function::exp, "exact_exp", "from -80 to 80", x);
  check(Function::sinh, "exact_sinh", "from -80 to 80", x);
  check(Function::cosh, "exact_cosh", "from -80 to 80", x);
  check(Function::tanh, "exact_tanh", "from -80 to 80", x);
  check(Function::tan, "exact_tan", "from -80 to 80", x);
  check(Function::log, "exact_log", "every 4001st float", floats_between(0.0f, float_of(kInfinityBits), 4001));
}

TEST_CASE("lanes of every width and single numbers give the same bits") {
  Random random(3);
  std::vector<float> x, y;
  for (int i = 0; i < 20000; ++i) {
    x.push_back(i % 2 ? random.uniform(-4, 4) : float_of(random.bits()));
    y.push_back(i % 2 ? random.uniform(-9, 9) : float_of(random.bits()));
  }
  for (const Number number : {Number::lanes4, Number::lanes16, Number::scalar}) {
    const RowShader other("transcendental", kTranscendentalShader, number);
    for (int f = 0; f < kFunctions; ++f) {
      const std::vector<float> a = evaluate(shader(), static_cast<Function>(f), x, y);
      const std::vector<float> b = evaluate(other, static_cast<Function>(f), x, y);
      int different = 0;
      for (std::size_t i = 0; i < a.size(); ++i)
        different += bits_of(a[i]) != bits_of(b[i]) && !(std::isnan(a[i]) && std::isnan(b[i]));
      CAPTURE(static_cast<int>(number));
      CAPTURE(f);
      CHECK(different == 0);
    }
  }
}

}  // namespace twinshade::test
