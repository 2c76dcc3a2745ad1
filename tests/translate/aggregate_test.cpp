// Structures, arrays and matrices: passed, indexed, divided, chosen between, read before they are written. Expected
// values are worked out here.
#include <algorithm>

#include "shader_checks.h"

namespace twinshade {
SHADER(arguments)
SHADER(input_arrays)
SHADER(matrix_division)
SHADER(selections)
SHADER(unwritten)

TEST_CASE("a structure or array that is passed stays what it was while the callee writes the variable") {
  Invocations in;
  in.input = small_integers;
  for (Number number : kAll) {
    const Answer answer = RUN(arguments, number, in);
    for (std::uint32_t i = 0; i < in.count; ++i) {
      const int a = small_a(i), b = small_b(i);
      const double expected[] = {a + 50.0, a + b * 100.0, 7.0 + b * 10 + a * 1000 + (a + 1) * 10000,
                                 a != 3 ? b * 10.0 + a : a * 10.0 + b};
      const double list[] = {1000, 1000, a + double(b), b + 2.0};
      for (std::size_t c = 0; c < 4; ++c) {
        check_value(answer, "answer", c, i, expected[c], number);
        check_value(answer, "list", c, i, list[c], number);
      }
    }
  }
}

TEST_CASE("an index outside an input array means the nearest element") {
  Invocations in;
  in.input = [](const std::string& name, std::uint32_t c, std::uint32_t i) -> double {
    return name == "a" ? small_a(i) : 10.0 * (c + 1) + i;
  };
  in.uniforms["below"] = {-1};
  in.uniforms["above"] = {3};
  in.uniforms["far"] = {3e9f};
  for (Number number : kAll) {
    const Answer answer = RUN(input_arrays, number, in);
    for (std::uint32_t i = 0; i < in.count; ++i) {
      const int a = small_a(i);
      const auto element = [&](int k) { return 10.0 * (std::min(std::max(k, 0), 2) + 1) + i; };
      const double same[] = {element(0), element(2), element(2), element(0)};
      const double own[] = {element(a - 1), element(2), element(2), element(a - 3)};
      for (std::size_t c = 0; c < 4; ++c) {
        check_value(answer, "same", c, i, same[c], number);
        check_value(answer, "own", c, i, own[c], number);
      }
    }
  }
}

namespace {
// The values of matrix_division.frag in the arithmetic of Real.
template <class Real>
void check_divisions(Number number) {
  Invocations in;
  const auto v = [](std::uint32_t c, std::uint32_t i) { return static_cast<Real>(i * 4 + c + 1); };
  in.input = [&](const std::string&, std::uint32_t c, std::uint32_t i) { return static_cast<double>(v(c, i)); };
  in.uniforms["scale"] = {3};
  const Answer answer = RUN(matrix_division, number, in);
  for (std::uint32_t i = 0; i < in.count; ++i)
    for (std::uint32_t c = 0; c < 4; ++c) {
      check_value(answer, "divided", c, i, v(c, i) / v(0, i), number);
      check_value(answer, "by_uniform", c, i, v(c, i) / Real(3), number);
      check_value(answer, "times_reciprocal", c, i, v(c, i) * (Real(1) / v(0, i)), number);
      check_value(answer, "assigned", c, i, v(c, i) / (v(0, i) + Real(1)), number);
    }
}
}  // namespace

TEST_CASE("a matrix is divided by a scalar, and multiplied by a reciprocal only where the shader says so") {
  for (Number number : kFloats) check_divisions<float>(number);
  check_divisions<double>(Number::float64);
}

TEST_CASE("structures and arrays are chosen between, uniform or not, tables or not") {
  Invocations in;
  in.input = small_integers;
  in.uniforms["left"] = {1, 2, 3, 4};
  in.uniforms["right"] = {5, 6, 7, 8};
  for (const bool first : {false, true}) {
    in.uniforms["u"] = {first ? 0.5f : -0.5f};
    in.uniforms["n"] = {first ? 4.0f : 3.0f};
    const double u = first ? 0.5 : -0.5;
    for (Number number : kAll) {
      const Answer answer = RUN(selections, number, in);
      for (std::uint32_t i = 0; i < in.count; ++i) {
        const int a = small_a(i), k = a & 3;
        const double p = u + 10, q = 2 + u * 10;
        const double structures[] = {first ? p : q, a > 3 ? p : q, first ? u : 2, 1};
        const double arrays[] = {(first ? 1 : 5) + (k + 1) * 10.0, k + (a > 3 ? 1 : 5) + (k + 5) * 10.0,
                                 first ? 2.0 : 6.0, a > 3 ? 3.0 : 7.0};
        for (std::size_t c = 0; c < 4; ++c) {
          check_value(answer, "structures", c, i, structures[c], number);
          check_value(answer, "arrays", c, i, arrays[c], number);
        }
      }
    }
  }
}

TEST_CASE("arrays that are given a constant once are zero before it and where it is not reached") {
  Invocations in;
  in.input = small_integers;
  in.uniforms["n"] = {0};
  for (Number number : kAll) {
    const Answer answer = RUN(unwritten, number, in);
    for (std::uint32_t i = 0; i < in.count; ++i) {
      const int a = small_a(i);
      const double expected[] = {a > 3 ? 1.0 : 0.0, a > 3 ? 1.0 + (a & 1) : 0.0, 0, (a & 1) != 0 ? 20.0 : 10.0};
      for (std::size_t c = 0; c < 4; ++c) check_value(answer, "answer", c, i, expected[c], number);
    }
  }
}

}  // namespace twinshade
