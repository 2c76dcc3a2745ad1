#include "experiments/basis_cost.h"

#include <doctest/doctest.h>

#include "base/error.h"

using namespace twinshade;

namespace {

OperationCount counted(const std::string& body) {
  const ShaderSource source =
      resolve_shader("counted",
                     "in vec3 a;\nin float b;\nout vec3 result;\nvec3 memory() { return a * 2.0; }\n" + body +
                         "\nvoid main() { result = f(); }\n",
                     "counted.frag");
  return count_operations(source, "f", "memory");
}

}  // namespace

TEST_CASE("operations are counted by component, calls with what they do") {
  const OperationCount count = counted(
      "float g(float x) { return sqrt(x) / (x + 1.0); }\n"
      "vec3 f() { return memory() * g(b) - a; }");
  CHECK(count.additions == 1 + 3);
  CHECK(count.multiplications == 3);  // memory() is free
  CHECK(count.divisions == 1);
  CHECK(count.square_roots == 1);
  CHECK(count.total() == 9);
  CHECK_FALSE(count.loops);
}

TEST_CASE("of branches the dearest counts, and its comparison") {
  const OperationCount count = counted(
      "vec3 f() {\n  vec3 r = a;\n  if (b > 0.0) {\n    r *= b;\n    r += a;\n    r.x = r.y / r.z;\n  } else {\n    r "
      "+= a;\n  }\n"
      "  return r;\n}");
  CHECK(count.additions == 3);
  CHECK(count.multiplications == 3);
  CHECK(count.divisions == 1);
  CHECK(count.selections == 1);
}

TEST_CASE("a loop is counted once, and said to be one") {
  const OperationCount count =
      counted("vec3 f() {\n  vec3 r = a;\n  for (int i = 0; i < int(b); ++i) r += a;\n  return r;\n}");
  CHECK(count.additions == 3);
  CHECK(count.loops);
}

TEST_CASE("a loop between constants is counted as often as it runs") {
  const auto body = [](const std::string& head) {
    return "vec3 f() {\n  vec3 r = a;\n  " + head + " r += a;\n  return r;\n}";
  };
  CHECK(counted(body("for (int i = 0; i < 9; ++i)")).additions == 27);
  CHECK(counted(body("for (int i = 8; i >= 2; i -= 2)")).additions == 12);
  CHECK(counted(body("for (uint i = 1u; i <= 3u; i++)")).additions == 9);
  CHECK(counted(body("for (int i = 3; i < 3; ++i)")).additions == 0);
  const OperationCount nested = counted(body("for (int i = 0; i < 3; ++i) for (int k = 0; k < 4; ++k)"));
  CHECK(nested.additions == 36);
  CHECK_FALSE(nested.loops);
  // What may end earlier, or counts otherwise, is only known to be a loop
  for (const std::string head :
       {"for (int i = 0; i < 9; ++i) if (b > float(i)) break; else", "for (int i = 0; i < 9; i += 1 + i)",
        "for (int i = 0; i < 9; ++i) for (; i < 7; ++i)"}) {
    CAPTURE(head);
    CHECK(counted(body(head)).loops);
  }
}

TEST_CASE("a function that is not there is named") {
  CHECK_THROWS_WITH_AS(count_operations(basis_irradiance_source(find_technique("h4")), "nothing", ""),
                       doctest::Contains("nothing"), UserError);
}

TEST_CASE("what bases cost") {
  const BasisCost h4 = basis_cost(find_technique("h4"));
  CHECK(h4.coefficients == 4);
  CHECK(h4.reads == 4);
  // Four vectors times a value, three sums, and the values: -sqrt(3/2pi) y, sqrt(3/2pi) (2z - 1), -sqrt(3/2pi) x
  CHECK(h4.operations.multiplications == 4 * 3 + 3);
  CHECK(h4.operations.additions == 3 * 3 + 1);
  CHECK(h4.operations.divisions + h4.operations.square_roots + h4.operations.selections == 0);
  for (const TechniqueInfo& technique : techniques()) {
    if (!technique.is_basis) continue;
    CAPTURE(technique.name);
    const BasisCost cost = basis_cost(technique);
    CHECK(cost.reads >= 1);
    CHECK(cost.operations.others == 0);  // the exact dialect has no transcendental built-ins
    CHECK(cost.operations.total() >= (technique.count > 1 ? 3 : 0));
    // Three vertices of a triangle, or three faces of a cube, with all that is stored there
    if (technique.name == "ambient_cube") CHECK(cost.reads == 3);
    if (technique.name == "ad_linear_planar") CHECK(cost.reads == 3);
    if (technique.name == "ad_spherical") CHECK(cost.reads == 9);
  }
}
