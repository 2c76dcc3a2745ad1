// Products, lengths and interpolation of shaders/exact/ against long double.
#include <doctest/doctest.h>

#include <array>
#include <cmath>

#include "tests/exact/shader_rows.h"

namespace twinshade::test {
namespace {

constexpr const char* kAlgebra = R"(
#include "exact/cross.glsl"
#include "exact/fract.glsl"
#include "exact/matrix.glsl"
#include "exact/mix.glsl"
#include "exact/mod.glsl"
#include "exact/normalize.glsl"
#include "exact/reflect.glsl"

in vec4 a;
in vec4 b;
in mat4 m;
layout(location = 0) out vec4 dots;        // of 2, 3, 4 components; length of a
layout(location = 1) out vec4 unit;        // a normalised
layout(location = 2) out vec3 perpendicular;
layout(location = 3) out vec3 reflected;   // a.xyz at the plane of b.xyz normalised
layout(location = 4) out vec4 mixed;       // a to b by a.x
layout(location = 5) out vec4 parts;       // fract(a.x), mod(a.x, b.x), mix at 0 and 1 equal a.x, b.x
layout(location = 6) out vec4 columns;     // m * a
layout(location = 7) out vec4 rows;        // a * m
layout(location = 8) out vec4 associated;  // (m * m) * a
layout(location = 9) out vec3 small;       // mat3(m) * a.xyz
layout(location = 10) out vec2 smallest;   // a.xy * mat2(m)

void main() {
  dots = vec4(exact_dot(a.xy, b.xy), exact_dot(a.xyz, b.xyz), exact_dot(a, b), exact_length(a));
  unit = exact_normalize(a);
  perpendicular = exact_cross(a.xyz, b.xyz);
  reflected = exact_reflect(a.xyz, exact_normalize(b.xyz));
  mixed = exact_mix(a, b, a.x);
  bool ends = exact_mix(a.x, b.x, 0.0) == a.x && exact_mix(a.x, b.x, 1.0) == b.x;
  parts = vec4(exact_fract(a.x), exact_mod(a.x, b.x), ends ? 1.0 : 0.0, 0.0);
  columns = exact_multiply(m, a);
  rows = exact_multiply(a, m);
  associated = exact_multiply(exact_multiply(m, m), a);
  small = exact_multiply(mat3(m), a.xyz);
  smallest = exact_multiply(a.xy, mat2(m));
}
)";

constexpr std::size_t kRows = 4096;

struct Data {
  std::vector<float> inputs, outputs;
  float a(std::size_t row, std::size_t i) const { return inputs[i * kRows + row]; }
  float b(std::size_t row, std::size_t i) const { return inputs[(4 + i) * kRows + row]; }
  float m(std::size_t row, std::size_t column, std::size_t i) const {
    return inputs[(8 + 4 * column + i) * kRows + row];
  }
};

const Data& data() {
  static const Data made = [] {
    Data d;
    Random random(5);
    for (std::size_t i = 0; i < 24 * kRows; ++i) d.inputs.push_back(random.uniform(-2, 2));
    d.outputs = RowShader("algebra", kAlgebra, Number::scalar).run(d.inputs, kRows);
    return d;
  }();
  return made;
}

// Component of an output, outputs in order of location.
float output(std::size_t row, std::size_t location, std::size_t i) {
  static constexpr std::array<std::size_t, 11> kFirst = {0, 4, 8, 11, 14, 18, 22, 26, 30, 34, 37};
  return data().outputs[(kFirst[location] + i) * kRows + row];
}

constexpr double kEpsilon = 0x1p-24;  // rounding of one operation, relative

struct Sum {
  long double value = 0, magnitude = 0;
  void add(long double x, long double y) {
    value += x * y;
    magnitude += std::fabs(x * y);
  }
};

void check_sum(float computed, const Sum& sum, int operations) {
  CHECK(std::fabs(computed - sum.value) <= operations * kEpsilon * sum.magnitude);
}

}  // namespace

TEST_CASE("dot products and lengths err by no more than their roundings") {
  for (std::size_t row = 0; row < kRows; ++row) {
    Sum dot, square;
    for (std::size_t i = 0; i < 4; ++i) {
      dot.add(data().a(row, i), data().b(row, i));
      square.add(data().a(row, i), data().a(row, i));
      if (i > 0) check_sum(output(row, 0, i - 1), dot, static_cast<int>(i) + 1);
    }
    CHECK(ulp_error(output(row, 0, 3), std::sqrt(square.value)) <= 3);
  }
}

TEST_CASE("a normalised vector is a positive multiple of unit length") {
  for (std::size_t row = 0; row < kRows; ++row) {
    Sum square, along;
    for (std::size_t i = 0; i < 4; ++i) {
      square.add(output(row, 1, i), output(row, 1, i));
      along.add(output(row, 1, i), data().a(row, i));
    }
    CHECK(std::fabs(square.value - 1) <= 10 * kEpsilon);
    CHECK(ulp_error(output(row, 0, 3), along.value) <= 8);
  }
}

TEST_CASE("a cross product has the determinant's components") {
  for (std::size_t row = 0; row < kRows; ++row)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
      Sum component;
      component.add(data().a(row, j), data().b(row, k));
      component.add(-data().a(row, k), data().b(row, j));
      check_sum(output(row, 2, i), component, 2);
    }
}

TEST_CASE("reflection keeps the length and turns the normal component round") {
  for (std::size_t row = 0; row < kRows; ++row) {
    Sum before, after, normal_before, normal_after;
    for (std::size_t i = 0; i < 3; ++i) {
      before.add(data().a(row, i), data().a(row, i));
      after.add(output(row, 3, i), output(row, 3, i));
      normal_before.add(data().a(row, i), data().b(row, i));
      normal_after.add(output(row, 3, i), data().b(row, i));
    }
    const long double scale = normal_before.magnitude + normal_after.magnitude + before.value;
    CHECK(std::fabs(before.value - after.value) <= 32 * kEpsilon * scale);
    CHECK(std::fabs(normal_before.value + normal_after.value) <= 32 * kEpsilon * scale);
  }
}

TEST_CASE("mix meets its ends and lies between by its weight") {
  for (std::size_t row = 0; row < kRows; ++row) {
    CHECK(output(row, 5, 2) == 1.0f);
    for (std::size_t i = 0; i < 4; ++i) {
      Sum mixed;
      mixed.add(data().a(row, i), 1.0L - data().a(row, 0));
      mixed.add(data().b(row, i), data().a(row, 0));
      check_sum(output(row, 4, i), mixed, 3);
    }
  }
}

TEST_CASE("fract and mod are what is left of whole steps") {
  for (std::size_t row = 0; row < kRows; ++row) {
    const long double x = data().a(row, 0), y = data().b(row, 0);
    CHECK(std::fabs(output(row, 5, 0) - (x - std::floor(x))) <= kEpsilon);
    const long double remainder = x - y * std::floor(static_cast<long double>(data().a(row, 0) / data().b(row, 0)));
    CHECK(std::fabs(output(row, 5, 1) - remainder) <= 2 * kEpsilon * (std::fabs(x) + std::fabs(remainder)));
  }
}

TEST_CASE("matrix products sum over the right index") {
  for (std::size_t row = 0; row < kRows; ++row) {
    for (std::size_t i = 0; i < 4; ++i) {
      Sum column_sum, row_sum, twice, small, smallest;
      for (std::size_t j = 0; j < 4; ++j) {
        column_sum.add(data().m(row, j, i), data().a(row, j));
        row_sum.add(data().m(row, i, j), data().a(row, j));
        for (std::size_t k = 0; k < 4; ++k)
          twice.add(static_cast<long double>(data().m(row, k, i)) * data().m(row, j, k), data().a(row, j));
        if (j < 3 && i < 3) small.add(data().m(row, j, i), data().a(row, j));
        if (j < 2 && i < 2) smallest.add(data().m(row, i, j), data().a(row, j));
      }
      check_sum(output(row, 6, i), column_sum, 4);
      check_sum(output(row, 7, i), row_sum, 4);
      check_sum(output(row, 8, i), twice, 9);
      if (i < 3) check_sum(output(row, 9, i), small, 3);
      if (i < 2) check_sum(output(row, 10, i), smallest, 2);
    }
  }
}

}  // namespace twinshade::test
