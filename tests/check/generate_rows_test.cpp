// Declared ranges, and the rows that come of them.
#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <set>

#include "base/error.h"
#include "check/generate_rows.h"

namespace twinshade {
namespace {

ShaderSource shader(const std::string& comments) {
  return resolve_shader("s", comments + "\nvoid main() {}\n", "s.frag");
}

Reflection reflection_of(const std::string& name, std::uint8_t rows, Scalar scalar = Scalar::f32) {
  Reflection reflection;
  ReflectedVariable input;
  input.name = name;
  input.rows = rows;
  input.scalar = scalar;
  reflection.inputs = {input};
  return reflection;
}

std::vector<float> values_of(const std::string& range, std::uint8_t rows) {
  const ValueTable table = generate_rows(reflection_of("x", rows), declared_ranges(shader(range)), {512, 7});
  std::vector<float> values;
  for (const std::uint32_t bits : table.inputs.at(0).bits) values.push_back(std::bit_cast<float>(bits));
  return values;
}

bool has(const std::vector<float>& values, float value) {
  for (const float v : values)
    if (std::bit_cast<std::uint32_t>(v) == std::bit_cast<std::uint32_t>(value)) return true;
  return false;
}

}  // namespace

TEST_CASE("values lie in their interval, its ends and the special values within it among them") {
  const std::vector<float> values = values_of("// @input x -2..3", 2);
  CHECK(values.size() == 1024);
  for (const float v : values) CHECK((v >= -2 && v <= 3));
  for (const float special : {-2.0f, 3.0f, 0.0f, -0.0f, 1.0f, -1.0f, 0x1p-149f}) CHECK(has(values, special));
  CHECK(!has(values_of("// @input x 0..1", 1), -0.0f));
}

TEST_CASE("intervals by component, lists, unit vectors, all floats") {
  const std::vector<float> pairs = values_of("// @input x 0..1 5..6", 2);
  for (std::size_t i = 0; i < pairs.size(); i += 2) CHECK((pairs[i] <= 1 && pairs[i + 1] >= 5));
  std::set<float> listed;
  for (const float v : values_of("// @input x {0.5, 2, 7}", 1)) listed.insert(v);
  CHECK(listed == std::set<float>{0.5f, 2.0f, 7.0f});
  const std::vector<float> unit = values_of("// @input x unit", 3);
  for (std::size_t i = 0; i < unit.size(); i += 3)
    CHECK(unit[i] * unit[i] + unit[i + 1] * unit[i + 1] + unit[i + 2] * unit[i + 2] == doctest::Approx(1));
  int nans = 0, infinities = 0;
  for (const float v : values_of("// @input x any", 1)) {
    nans += std::isnan(v);
    infinities += std::isinf(v);
  }
  CHECK(nans > 0);
  CHECK(infinities > 0);
  for (const float v : values_of("// @input x finite", 1)) CHECK(std::isfinite(v));
}

TEST_CASE("the same seed gives the same rows, another one others") {
  const Reflection reflection = reflection_of("x", 3);
  const auto bits = [&](std::uint64_t seed) { return generate_rows(reflection, {}, {64, seed}).inputs[0].bits; };
  CHECK(bits(1) == bits(1));
  CHECK(bits(1) != bits(2));
}

TEST_CASE("a range that cannot be meant is refused at its line") {
  for (const std::string bad : {"// @input x 1..0", "// @input x", "// @input x 0..b", "// @input x {}",
                                "// @input x wide", "// @input x {1, 2} {3, 4}"}) {
    CAPTURE(bad);
    CHECK_THROWS_WITH_AS(declared_ranges(shader("\n" + bad)), doctest::Contains("s.frag:2: "), UserError);
  }
  const Reflection reflection = reflection_of("x", 2);
  for (const std::string bad : {"// @input y 0..1", "// @input x 0..1 0..1 0..1"}) {
    CAPTURE(bad);
    CHECK_THROWS_WITH_AS(generate_rows(reflection, declared_ranges(shader(bad)), {}), doctest::Contains("s.frag:1: "),
                         UserError);
  }
  CHECK_THROWS_AS(generate_rows(reflection_of("x", 1, Scalar::i32), declared_ranges(shader("// @input x any")), {}),
                  UserError);
}

TEST_CASE("values that a type cannot hold are refused at their line") {
  const auto said = [](Scalar scalar, const std::string& range) -> std::string {
    try {
      generate_rows(reflection_of("x", 1, scalar), declared_ranges(shader("\n// @input x " + range)), {16, 1});
    } catch (const UserError& error) {
      return error.what();
    }
    return "";
  };
  const std::string of_int = ": x is an int: give whole numbers from -2147483648 to 2147483647";
  CHECK(said(Scalar::i32, "0.5..2") == "s.frag:2: 0.5" + of_int);
  CHECK(said(Scalar::i32, "{1.5}") == "s.frag:2: 1.5" + of_int);
  CHECK(said(Scalar::i32, "5.5..5.7") == "s.frag:2: 5.5" + of_int);
  CHECK(said(Scalar::i32, "3e9..4e9") == "s.frag:2: 3e+09" + of_int);
  CHECK(said(Scalar::u32, "-1..5").find("s.frag:2: -1: x is a uint") == 0);
  CHECK(said(Scalar::f32, "0..1e99").find("s.frag:2: 1e+99: x is a float") == 0);
  CHECK(said(Scalar::f32, "{1e39}").find("s.frag:2: 1e+39: x is a float") == 0);
  CHECK(said(Scalar::boolean, "0..2").find("s.frag:2: 2: x is a bool") == 0);
  CHECK(said(Scalar::boolean, "1..1").find("s.frag:2: x is a bool") == 0);
  CHECK(said(Scalar::i32, "-2147483648..2147483647") == "");
  CHECK(said(Scalar::u32, "3e9..4294967295") == "");
  CHECK(said(Scalar::f32, "-3.40282347e38..3.40282347e38") == "");
  for (const std::string range : {"0..1", "{0, 1}", "{1}"}) CHECK(said(Scalar::boolean, range) == "");
}

TEST_CASE("samplers take one interval of floats, blocks none") {
  Reflection reflection;
  reflection.resources.resize(2);
  reflection.resources[0].name = "map";
  reflection.resources[0].kind = ResourceKind::sampler_2d;
  reflection.resources[1].name = "Block";
  reflection.resources[1].kind = ResourceKind::uniform_block;
  for (const std::string bad : {"map {1}", "map unit", "map 0..1 0..1", "map 0..1e99", "Block 0..1"}) {
    CAPTURE(bad);
    CHECK_THROWS_WITH_AS(generate_rows(reflection, declared_ranges(shader("// @input " + bad)), {}),
                         doctest::Contains("s.frag:1: "), UserError);
  }
  const ValueTable table = generate_rows(reflection, declared_ranges(shader("// @input map 5..6")), {});
  REQUIRE(table.textures.size() == 1);
  for (const float texel : table.textures[0].texels) CHECK((texel >= 5 && texel <= 6));
}

TEST_CASE("what stands behind a range, or is nearly one, is refused at its line") {
  const auto refusal = [](const std::string& comment) -> std::string {
    try {
      declared_ranges(shader("\n" + comment));
    } catch (const UserError& error) {
      return error.what();
    }
    return "";
  };
  CHECK(refusal("// @input x 0..1 5 3..4").find("s.frag:2: \"5\" is too much") == 0);
  for (const std::string range : {"0..1 5", "{1, 2} 3", "any 0..1", "unit unit", "any any any", "0..1 finite",
                                  "{1, 2} unit", "0..1 0..1 any component"})
    CHECK_MESSAGE(refusal("// @input x " + range).find("is too much behind the range") != std::string::npos, range);
  for (const std::string range :
       {"0...1", "0..1..2", "--1..2", "0x..1", "0x-1..2", "-0x..1", "++1..2", "+-1..2", "-+1..2", "+..1"})
    CHECK_MESSAGE(refusal("// @input x " + range) != "", range);
  CHECK(refusal("// @inputs x 1..2").find("s.frag:2: unknown comment @inputs") == 0);
  CHECK(refusal("// @inputs are what follows") == "");
  for (const std::string range :
       {"0..1 every component", "unit vectors of length 1", "0..1 // every component", "{1, 2} // two", "unit//long",
        "-0x1.8p-3..0x1p3", "finite values", "unit // any direction", "0..1 units", "0..1 of any kind"})
    CHECK_MESSAGE(refusal("// @input x " + range) == "", range);
  CHECK(declared_ranges(shader("// @input x -0x1.8p-3..0x1p3")).at(0).intervals.at(0) == std::pair(-0.1875, 8.0));
  CHECK(declared_ranges(shader("// @input x -1..+1 +0x1p3..+1e+9")).at(0).intervals ==
        std::vector{std::pair(-1.0, 1.0), std::pair(8.0, 1e9)});
  CHECK(declared_ranges(shader("// @input x {-1, +2}")).at(0).values == std::vector{-1.0, 2.0});
}

TEST_CASE("a range within a block comment is none") {
  CHECK(declared_ranges(shader("/* // @input x 3..4 */\n/*\n// @input y 0..1\n*/ // @input z 0..1")).size() == 1);
  CHECK(declared_ranges(shader("// /*\n// @input x 3..4\n//*/")).size() == 1);
}

TEST_CASE(
    "a #line in a comment, one without a number and a pragma that resembles our own keep no range from being read") {
  CHECK(declared_ranges(shader("/*\n#line up with the others\n*/\n// @input x 0..1")).at(0).where == "s.frag:4: ");
  CHECK(declared_ranges(shader("#line 99999999999999999999\n// @input x 0..1")).size() == 1);
  CHECK(declared_ranges(shader("#line  7\n// @input x 0..1")).at(0).where == "s.frag:7: ");
  for (const char* number : {"", "own", "99999999999999999999", "-1"})
    CHECK(
        declared_ranges(shader("#pragma twinshade_input_" + std::string(number) + "\n#if 1\n// @input x 0..1\n#endif"))
            .size() == 1);
}

TEST_CASE("a second line for the same input is refused, with the place of the first") {
  CHECK_THROWS_WITH_AS(declared_ranges(shader("// @input x 0..1\n\n// @input x 0..2")),
                       "s.frag:3: a second range for x, after s.frag:1: keep one; a side file goes before comments",
                       UserError);
}

TEST_CASE("of the ranges in the branches of an #if, those of the one that is compiled count, at their lines") {
  const char* const text =
      "#define WIDE 1\n#if WIDE\n// @input x 5..6\n#else\n// @input x 0..1\n// @input gone 0..1\n#endif\n"
      "in float y; // @input y {2}";
  const std::vector<InputRange> ranges = declared_ranges(shader(text));
  REQUIRE(ranges.size() == 2);
  CHECK(ranges[0].where == "s.frag:3: ");
  CHECK(ranges[1].where == "s.frag:8: ");
  CHECK(ranges[0].intervals == std::vector{std::pair{5.0, 6.0}});
  CHECK(declared_ranges(shader("# ifdef A\n// @input x 0..1\n# else\n// @input x 0..2\n# endif")).size() == 1);
  // No pragma may stand among a macro's arguments: then all comments count.
  CHECK(declared_ranges(shader("#if 1\n#endif\n#define F(a, b) a + b\nfloat y = F(1.0, // @input x 0..1\n2.0);"))
            .size() == 1);
  CHECK_THROWS_WITH_AS(declared_ranges(shader("#if 1\n// @input x 0..1\n#endif\n#error no")),
                       doctest::Contains("s.frag:4: "), UserError);
}

}  // namespace twinshade
