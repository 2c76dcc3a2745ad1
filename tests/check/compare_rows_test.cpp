// Rows of two machines: what counts as a difference.
#include <doctest/doctest.h>

#include <bit>
#include <limits>

#include "check/compare_rows.h"

namespace twinshade {
namespace {

EvaluatedRows rows_of(const std::vector<float>& values) {
  EvaluatedRows rows;
  Values output;
  output.name = "color";
  for (const float value : values) output.bits.push_back(std::bit_cast<std::uint32_t>(value));
  rows.outputs = {output};
  rows.kept.assign(values.size(), 1);
  return rows;
}

}  // namespace

TEST_CASE("NaN is one class, zeros differ by their sign, denormals against zero are counted apart") {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const RowComparison c =
      compare_rows(rows_of({nan, 0.0f, 1e-42f, 1.0f, 1.0f}), rows_of({-nan, -0.0f, 0.0f, 1.0f, 1.0f + 0x1p-23f}));
  CHECK(c.compared == 5);
  CHECK(c.differ == 3);
  CHECK(c.denormal_only == 1);
  CHECK(c.max_ulp == 1);
  CHECK(c.rows == std::vector<std::size_t>{1, 4});
  REQUIRE(c.first);
  CHECK(c.first->row == 1);
}

TEST_CASE("a denormal is flushed to the zero of its sign: any other zero differs") {
  const RowComparison c =
      compare_rows(rows_of({1e-42f, -1e-42f, -1e-42f, 0.0f}), rows_of({0.0f, -0.0f, 0.0f, -1e-42f}));
  CHECK(c.differ == 4);
  CHECK(c.denormal_only == 2);
  CHECK(c.rows == std::vector<std::size_t>{2, 3});
}

TEST_CASE("what is within the distance that is allowed does not differ") {
  const float near = 1.0f + 0x1p-23f, far = 1.0f + 0x1p-20f;
  const RowComparison c = compare_rows(rows_of({0.0f, 1.0f, 1.0f}), rows_of({-0.0f, near, far}), {}, 2);
  CHECK(c.differ == 1);
  CHECK(c.within == 2);
  CHECK(c.rows == std::vector<std::size_t>{2});
  REQUIRE(c.first);
  CHECK(c.first->row == 2);
  CHECK(c.max_ulp == 8);
  CHECK(compare_rows(rows_of({0.0f}), rows_of({-0.0f})).within == 0);
}

TEST_CASE("a discard on one side differs, outputs of discarded rows do not") {
  EvaluatedRows a = rows_of({1, 2, 3}), b = rows_of({1, 5, 3});
  a.kept = {1, 0, 1};
  b.kept = {1, 0, 0};
  const RowComparison c = compare_rows(a, b);
  CHECK(c.rows == std::vector<std::size_t>{2});
  CHECK(c.first->output == "discard");
  CHECK(compare_rows(a, b, {false, false, true}).differ == 0);
}

}  // namespace twinshade
