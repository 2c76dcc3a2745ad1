// Division and square root by integers are those of the processor, bit by bit.
#include <doctest/doctest.h>

#include <cmath>

#include "tests/exact/shader_rows.h"

namespace twinshade::test {
namespace {

constexpr const char* kWrittenOut = R"(
#include "exact/written_out.glsl"
in vec2 operands;
layout(location = 0) out vec2 result;
layout(location = 1) out vec3 chosen;
void main() {
  result = vec2(written_divide(operands.x, operands.y), written_sqrt(operands.x));
  chosen = vec3(written_min(operands.x, operands.y), written_max(operands.x, operands.y),
                written_clamp(operands.x, -1.0, operands.y));
}
)";

float without_denormals(float x) { return std::fpclassify(x) == FP_SUBNORMAL ? std::copysign(0.0F, x) : x; }

// Correctly rounded by way of double, which has more than twice the digits; tiny after rounding is 0.
float rounded(double exact) {
  const auto nearest = static_cast<float>(exact);
  const bool tiny = std::fabs(exact) < 0x1p-126 - 0x1p-151;
  return tiny ? std::copysign(0.0F, nearest) : nearest;
}

bool same(float a, float b) { return std::isnan(a) ? std::isnan(b) : bits_of(a) == bits_of(b); }

void check(const RowShader& shader, const std::vector<std::uint32_t>& x, const std::vector<std::uint32_t>& y) {
  const std::size_t n = x.size();
  std::vector<float> inputs(2 * n);
  for (std::size_t i = 0; i < n; ++i) inputs[i] = float_of(x[i]), inputs[n + i] = float_of(y[i]);
  const std::vector<float> results = shader.run(inputs, n);
  for (std::size_t i = 0; i < n; ++i) {
    const float a = without_denormals(inputs[i]), b = without_denormals(inputs[n + i]);
    const float quotient = rounded(static_cast<double>(a) / b), root = std::sqrt(a);
    REQUIRE_MESSAGE(same(results[i], quotient), hex(a), " / ", hex(b), ": ", hex(results[i]), ", not ", hex(quotient));
    REQUIRE_MESSAGE(same(results[n + i], root), "sqrt ", hex(a), ": ", hex(results[n + i]), ", not ", hex(root));
  }
}

}  // namespace

TEST_CASE("division and square root written out in integers round as IEEE 754 says") {
  const RowShader shader("written_out", kWrittenOut);
  std::vector<std::uint32_t> x, y;

  // Special and extreme values against each other
  std::vector<std::uint32_t> special;
  for (const std::uint32_t magnitude :
       {0U, 1U, 0x7fffffU, 0x800000U, 0x800001U, 0x3f000000U, 0x3f7fffffU, 0x3f800000U, 0x3f800001U, 0x40000000U,
        0x40490fdbU, 0x4b800000U, 0x7f000000U, 0x7f7ffffeU, 0x7f7fffffU, 0x7f800000U, 0x7f800001U, 0x7fc00000U})
    for (const std::uint32_t sign : {0U, 0x80000000U}) special.push_back(sign | magnitude);
  for (const std::uint32_t a : special)
    for (const std::uint32_t b : special) x.push_back(a), y.push_back(b);
  check(shader, x, y);

  // Any bits; and quotients near the borders of the range
  Random random(7);
  for (int round = 0; round < 8; ++round) {
    x.clear(), y.clear();
    for (int i = 0; i < 1 << 17; ++i) {
      const std::uint32_t a = random.bits(), b = random.bits();
      x.push_back(a);
      y.push_back(round % 2 == 0 ? b : (b & 0x807fffffU) | (((a >> 23) + (i % 2 == 0 ? 126U : 130U)) & 0xffU) << 23);
    }
    check(shader, x, y);
  }

  // Every significand under the root, with either parity of the exponent
  for (std::uint32_t first = 0x3f800000; first < 0x40800000; first += 1U << 17) {
    x.clear();
    for (std::uint32_t i = 0; i < 1U << 17; ++i) x.push_back(first + i);
    y.assign(x.size(), 0x3fc00000U);
    check(shader, x, y);
  }
}

TEST_CASE("min, max and clamp written out choose the second of two zeros and the number beside NaN") {
  const RowShader shader("written_out", kWrittenOut);
  const float nan = std::nanf("");
  const float tiny = 0x1p-130F;  // counts as 0
  const std::vector<float> x{0.0F, -0.0F, nan, 2.0F, 3.0F, -5.0F, tiny, 2.0F, -tiny},
      y{-0.0F, 0.0F, 2.0F, nan, 1.0F, 4.0F, 2.0F, -tiny, -1.0F};
  std::vector<float> inputs = x;
  inputs.insert(inputs.end(), y.begin(), y.end());
  const std::size_t n = x.size();
  const std::vector<float> r = shader.run(inputs, n);
  const std::vector<float> least{-0.0F, 0.0F, 2.0F, 2.0F, 1.0F, -5.0F, 0.0F, -0.0F, -1.0F},
      most{-0.0F, 0.0F, 2.0F, 2.0F, 3.0F, 4.0F, 2.0F, 2.0F, -0.0F},
      between{-0.0F, 0.0F, -1.0F, 2.0F, 1.0F, -1.0F, 0.0F, -0.0F, -1.0F};
  for (std::size_t i = 0; i < n; ++i) {
    CHECK(bits_of(r[2 * n + i]) == bits_of(least[i]));
    CHECK(bits_of(r[3 * n + i]) == bits_of(most[i]));
    CHECK(bits_of(r[4 * n + i]) == bits_of(between[i]));
  }
}

}  // namespace twinshade::test
