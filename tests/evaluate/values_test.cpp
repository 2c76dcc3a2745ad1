#include "evaluate/values.h"

#include <doctest/doctest.h>

using namespace twinshade;

TEST_CASE("every type's name finds the type again") {
  for (int scalar = 0; scalar < 4; ++scalar)
    for (std::uint32_t rows = 1; rows <= 4; ++rows)
      for (const std::uint32_t length : {0u, 1u, 7u}) {
        const ValueType type{Scalar(scalar), 1, rows, length};
        CHECK_MESSAGE(find_type(type_name(type)) == type, type_name(type));
      }
  for (std::uint32_t columns = 2; columns <= 4; ++columns)
    for (std::uint32_t rows = 2; rows <= 4; ++rows) {
      const ValueType type{Scalar::f32, columns, rows, 3};
      CHECK_MESSAGE(find_type(type_name(type)) == type, type_name(type));
    }
  CHECK(find_type("mat3x3") == find_type("mat3"));
}

TEST_CASE("what is no type of values is none") {
  for (const char* name : {"", "vec", "vec1", "vec5", "mat1", "mat3x", "mat3x5", "dvec2", "vec3[]", "vec3[0]", "vec3[2",
                           "vec3[2]x", "vec3[2][2]", "vec3[-1]", "vec3[99999999999]", "sampler2D", " float"})
    CHECK_MESSAGE(!find_type(name).has_value(), name);
}

TEST_CASE("components are named as GLSL reads them") {
  const ValueType matrices = find_type("mat3x2[2]").value();
  CHECK(component_name("m", matrices, 0) == "m[0][0].x");
  CHECK(component_name("m", matrices, 11) == "m[1][2].y");
  CHECK(component_name("f", {}, 0) == "f");
}
