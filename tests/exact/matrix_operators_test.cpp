// Inverses, determinants, products of any shape and rounding of shaders/exact/.
#include <doctest/doctest.h>

#include <cmath>

#include "tests/exact/shader_rows.h"

namespace twinshade::test {
namespace {

constexpr const char* kMatrixOperators = R"(
#include "exact/matrix_operators.glsl"
#include "exact/rounding.glsl"
#include "exact/smoothstep.glsl"

in mat4 m;
layout(location = 0) out vec4 identity;      // of inverse(m) m for 4, 3, 2: the largest error; m against itself transposed twice
layout(location = 1) out vec3 determinants;  // of 4, 3, 2
layout(location = 2) out vec3 shapes;        // (mat2x3 * mat3x2) * v
layout(location = 3) out vec4 rounded;       // round, sign, smoothstep, isnan + isinf

float largest(vec4 v) {
  vec4 a = abs(v);
  return max(max(a.x, a.y), max(a.z, a.w));
}

void main() {
  mat4 four = exact_subtract(exact_multiply(exact_inverse(m), m), mat4(1.0));
  mat3 three = exact_subtract(exact_multiply(exact_inverse(mat3(m)), mat3(m)), mat3(1.0));
  mat2 two = exact_subtract(exact_multiply(exact_inverse(mat2(m)), mat2(m)), mat2(1.0));
  identity.x = max(max(largest(four[0]), largest(four[1])), max(largest(four[2]), largest(four[3])));
  identity.y = max(max(largest(vec4(three[0], 0.0)), largest(vec4(three[1], 0.0))), largest(vec4(three[2], 0.0)));
  identity.z = max(largest(vec4(two[0], 0.0, 0.0)), largest(vec4(two[1], 0.0, 0.0)));
  identity.w = exact_outerProduct(m[0], m[1].xy)[1].z - exact_multiply(m[0].z, m[1].y);
  determinants = vec3(exact_determinant(m), exact_determinant(mat3(m)), exact_determinant(mat2(m)));
  mat2x3 a = mat2x3(m[0].xyz, m[1].xyz);
  mat3x2 b = mat3x2(m[2].xy, m[2].zw, m[3].xy);
  shapes = exact_multiply(exact_multiply(a, b), m[0].xyz) - exact_multiply(a, exact_multiply(b, m[0].xyz));
  float infinity = intBitsToFloat(0x7f800000);
  rounded = vec4(exact_round(m[0].x * 8.0) - roundEven(m[0].x * 8.0), exact_sign(m[0].x) * abs(m[0].x) - m[0].x,
                 exact_smoothstep(-2.0, 2.0, m[0].x),
                 (exact_isnan(m[0].x) ? 1.0 : 0.0) + (exact_isinf(infinity) && !exact_isnan(infinity) ? 0.0 : 1.0));
}
)";

long double determinant(const long double (&m)[4][4], int n) {
  if (n == 1) return m[0][0];
  long double sum = 0;
  for (int column = 0; column < n; ++column) {
    long double minor[4][4] = {};
    for (int c = 0, to = 0; c < n; ++c) {
      if (c == column) continue;
      for (int r = 1; r < n; ++r) minor[to][r - 1] = m[c][r];
      ++to;
    }
    sum += (column % 2 == 0 ? 1 : -1) * m[column][0] * determinant(minor, n - 1);
  }
  return sum;
}

}  // namespace

TEST_CASE("inverses undo, determinants are Laplace's, products associate, rounding is IEEE's") {
  constexpr std::size_t kMatrixRows = 2048;
  Random random(11);
  std::vector<float> inputs;
  for (std::size_t i = 0; i < 16 * kMatrixRows; ++i) inputs.push_back(random.uniform(-2, 2));
  const std::vector<float> out =
      RowShader("matrix_operators", kMatrixOperators, Number::scalar).run(inputs, kMatrixRows);
  const auto at = [&](std::size_t component, std::size_t row) { return out[component * kMatrixRows + row]; };
  for (std::size_t row = 0; row < kMatrixRows; ++row) {
    CAPTURE(row);
    long double m[4][4];
    for (std::size_t c = 0; c < 4; ++c)
      for (std::size_t r = 0; r < 4; ++r) m[c][r] = inputs[(4 * c + r) * kMatrixRows + row];
    for (int n = 4; n >= 2; --n) {
      const long double d = determinant(m, n);
      const std::size_t which = std::size_t(4 - n);
      CHECK(std::fabs(at(4 + which, row) - d) <= 200 * 0x1p-24);  // terms up to 16
      CHECK(at(which, row) <= 4000 * 0x1p-24 / std::min(1.0L, std::fabs(d)));
    }
    CHECK(at(3, row) == 0.0f);
    for (std::size_t i = 7; i < 10; ++i) CHECK(std::fabs(at(i, row)) <= 64 * 0x1p-22f);
    CHECK(at(10, row) == 0.0f);
    CHECK(at(11, row) == 0.0f);
    const long double t = (m[0][0] + 2) / 4;
    CHECK(std::fabs(at(12, row) - t * t * (3 - 2 * t)) <= 0x1p-21);
    CHECK(at(13, row) == 0.0f);
  }
}

}  // namespace twinshade::test
