#include "app/bench/overdraw.h"

#include <doctest/doctest.h>

using namespace twinshade;

TEST_CASE("each layer is the first one again, nearer by the same step of depth") {
  Bundle one;
  one.width = one.height = 8;
  one.clip_positions = {0, 0, 0, 1, 4, 0, 2, 4, 0, 1, 0.5f, 1};
  one.indices = {0, 1, 2};
  one.attributes.push_back({"v_uv", Scalar::f32, 2, {0, 0, 1, 0, 0, 1}});
  const Bundle three = bench::with_overdraw(one, 3);
  validate(three, "stacked");
  CHECK(three.triangle_count() == 3);
  CHECK(three.vertex_count() == 9);
  CHECK(three.attributes[0].values.size() == 18);
  for (std::size_t layer = 0; layer < 3; ++layer)
    for (std::size_t v = 0; v < 3; ++v) {
      CAPTURE(layer);
      CAPTURE(v);
      const float *first = &one.clip_positions[4 * v], *p = &three.clip_positions[4 * (3 * layer + v)];
      CHECK(three.indices[3 * layer + v] == 3 * layer + v);
      CHECK(p[0] == first[0]);
      CHECK(p[1] == first[1]);
      CHECK(p[3] == first[3]);
      CHECK(p[2] / p[3] == doctest::Approx(first[2] / first[3] - 0.002 * double(layer)));
      for (std::size_t c = 0; c < 2; ++c)
        CHECK(three.attributes[0].values[2 * (3 * layer + v) + c] == one.attributes[0].values[2 * v + c]);
    }
  CHECK(bench::with_overdraw(one, 1).indices == one.indices);
}
