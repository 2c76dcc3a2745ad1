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

}  // namespace twinshade
