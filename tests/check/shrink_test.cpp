// Shrinking against failures that are known.
#include <doctest/doctest.h>

#include <bit>

#include "check/shrink.h"

namespace twinshade {
namespace {

Values floats(const std::string& name, std::vector<float> values) {
  Values result;
  result.name = name;
  for (const float value : values) result.bits.push_back(std::bit_cast<std::uint32_t>(value));
  return result;
}

ValueTable table_of(float x, float y, float scale) {
  ValueTable table;
  table.rows = 1;
  table.inputs = {floats("x", {x}), floats("y", {y})};
  table.uniforms = {floats("scale", {scale})};
  return table;
}

float at(const Values& values, std::size_t row) {
  return std::bit_cast<float>(values.bits[values.row_count() == 1 ? 0 : row]);
}

Differs where(bool (*fails)(float x, float y, float scale)) {
  return [fails](const ValueTable& table) {
    std::vector<bool> differs(table.rows);
    for (std::size_t row = 0; row < table.rows; ++row)
      differs[row] = fails(at(table.inputs[0], row), at(table.inputs[1], row), at(table.uniforms[0], row));
    return differs;
  };
}

}  // namespace

TEST_CASE("what a failure does not need becomes zero, what it needs becomes as short as it can") {
  const ValueTable small = shrink(table_of(5.37f, -2.91f, 0.77f), {},
                                  where([](float x, float, float scale) { return x > 3 && scale != 0; }));
  CHECK(at(small.inputs[0], 0) == 4.0f);
  CHECK(at(small.inputs[1], 0) == 0.0f);
  CHECK(at(small.uniforms[0], 0) == 1.0f);
}

TEST_CASE("values stay within the range that was declared") {
  InputRange range;
  range.name = "x";
  range.intervals = {{4.5, 8}};
  const ValueTable small = shrink(table_of(5.37f, 1, 1), {range}, where([](float x, float, float) { return x > 3; }));
  CHECK(at(small.inputs[0], 0) >= 4.5f);
  CHECK(at(small.inputs[0], 0) <= 8.0f);
  CHECK(complexity(Scalar::f32, small.inputs[0].bits[0]) <
        complexity(Scalar::f32, std::bit_cast<std::uint32_t>(5.37f)));
}

TEST_CASE("uints beyond the largest int shrink within their range, floats to ends of theirs that are none") {
  InputRange range;
  range.name = "n";
  range.intervals = {{3e9, 4294967295.0}};
  ValueTable table = table_of(0.2f, 1, 1);
  Values uints;
  uints.name = "n";
  uints.type.scalar = Scalar::u32;
  uints.bits = {4294967295u};
  table.inputs.push_back(uints);
  const Differs always = [](const ValueTable& rows) { return std::vector<bool>(rows.rows, true); };
  const std::uint32_t smallest = shrink(table, {range}, always).inputs[2].bits[0];
  CHECK(smallest == 4294967295u);  // none is shorter
  range.intervals = {{2e9, 4294967295.0}};
  const std::uint32_t shorter = shrink(table, {range}, always).inputs[2].bits[0];
  CHECK(shorter == 2147483647u);

  range.name = "x";
  range.kind = InputRange::Kind::list;
  range.values = {0.2, -0.2};  // no float is either
  table.inputs[0] = floats("x", {-0.2f});
  CHECK(at(shrink(table, {range}, always).inputs[0], 0) == 0.2f);
}

TEST_CASE("changes that work only one at a time still end") {
  const ValueTable small =
      shrink(table_of(5.37f, 2.91f, 1), {}, where([](float x, float y, float) { return x != 0 || y != 0; }));
  CHECK((at(small.inputs[0], 0) == 0.0f) != (at(small.inputs[1], 0) == 0.0f));
}

TEST_CASE("a long array of uniforms becomes zero but for what matters, in few runs") {
  constexpr std::size_t kLength = 192, kNeeded = 77;
  ValueTable table = table_of(1, 1, 1);
  table.uniforms = {floats("samples", std::vector<float>(kLength, 0.77f))};
  table.uniforms[0].type.array_length = kLength;
  std::size_t runs = 0;
  const ValueTable small = shrink(table, {}, [&](const ValueTable& rows) {
    std::vector<bool> differs(rows.rows);
    const std::vector<std::uint32_t>& bits = rows.uniforms[0].bits;
    for (std::size_t row = 0; row < rows.rows; ++row)
      differs[row] = bits[(bits.size() == kLength ? 0 : row * kLength) + kNeeded] != 0;
    runs += rows.rows;
    return differs;
  });
  for (std::size_t i = 0; i < kLength; ++i) CHECK((small.uniforms[0].bits[i] != 0) == (i == kNeeded));
  CHECK(std::bit_cast<float>(small.uniforms[0].bits[kNeeded]) == 1.0f);
  CHECK(runs < 200);
}

}  // namespace twinshade
