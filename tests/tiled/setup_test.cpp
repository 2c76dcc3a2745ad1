// Vertices and triangles before coverage: many at once give what one at a time does, exactly.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "raster/tiled/kernels.h"
#include "raster/tiled/window.h"
#include "tests/tiled/machine_kernels.h"
#include "tests/tiled/random_scene.h"

using namespace twinshade;
using namespace twinshade::tiled;

namespace {

__extension__ using Wide = __int128;

float any_component(test::Random& random) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  constexpr float kOdd[] = {0.0f,      -0.0f,      1.0f,  -1.0f,  std::numeric_limits<float>::quiet_NaN(),
                            kInfinity, -kInfinity, 1e38f, -1e38f, 1e-38f};
  return random.below(5) == 0 ? kOdd[random.below(std::uint32_t(std::size(kOdd)))] : float(random.between(-2, 2));
}

std::uint32_t planes_outside(const float* p) {
  std::uint32_t bits = 0;
  for (int axis = 0; axis < 3; ++axis) {
    constexpr std::uint32_t kAbove[] = {kClipRight, kClipTop, kClipFar}, kBelow[] = {kClipLeft, kClipBottom, kClipNear};
    if (std::isnan(p[axis]) || std::isnan(p[3]) || p[axis] > p[3]) bits |= kAbove[axis];
    const float sum = p[axis] + p[3];
    if (std::isnan(sum) || sum < 0) bits |= kBelow[axis];
  }
  if (!std::all_of(p, p + 4, [](float c) { return std::isfinite(c); })) bits |= kNotFinite;
  return bits;
}

Wide floor_of_256th(Wide x) { return (x - ((x % 256 + 256) % 256)) / 256; }

// By definition, of vertices that are in no plane's way. False where nothing can be seen.
bool expected_triangle(const WindowVertex (&v)[3], const SetUpTriangles& call, RasterTriangle& t, bool& front) {
  Wide x[3], y[3];
  for (int i = 0; i < 3; ++i) {
    if (v[i].x == kUnusable || v[i].y == kUnusable) return false;
    x[i] = v[i].x;
    y[i] = v[i].y;
  }
  const Wide area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]);
  if (area == 0 || (area < 0 && call.cull_back_faces)) return false;
  if (area < 0) {
    std::swap(x[0], x[1]);
    std::swap(y[0], y[1]);
  }
  const auto first = [](Wide a, Wide b, Wide c) { return floor_of_256th(std::min({a, b, c}) + 255); };
  const auto last = [](Wide a, Wide b, Wide c) { return floor_of_256th(std::max({a, b, c})); };
  const Wide x0 = std::max<Wide>(first(x[0], x[1], x[2]), 0), y0 = std::max<Wide>(first(y[0], y[1], y[2]), 0);
  const Wide x1 = std::min<Wide>(last(x[0], x[1], x[2]), call.frame_width - 1);
  const Wide y1 = std::min<Wide>(last(y[0], y[1], y[2]), call.frame_height - 1);
  if (x0 > x1 || y0 > y1) return false;
  t = {};
  t.min_x = std::uint16_t(x0);
  t.min_y = std::uint16_t(y0);
  t.max_x = std::uint16_t(x1);
  t.max_y = std::uint16_t(y1);
  front = area > 0;
  const Wide wide = std::max({x[0], x[1], x[2]}) - std::min({x[0], x[1], x[2]});
  const Wide high = std::max({y[0], y[1], y[2]}) - std::min({y[0], y[1], y[2]});
  const auto [near, far] = std::minmax({v[0].depth, v[1].depth, v[2].depth});
  const bool thick = double(area < 0 ? -area : area) >= 128.0 * double(wide + high);
  t.nearest = thick ? near - (0.25f * (far - near) + 0x1p-19f) : -1.0f;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const Wide a = y[i] - y[j], b = x[j] - x[i];
    t.a[i] = std::int32_t(a);
    t.b[i] = std::int32_t(b);
    t.c[i] = std::int64_t(floor_of_256th(-(a * x[i] + b * y[i]) - (a > 0 || (a == 0 && b > 0) ? 0 : 1)));
  }
  return true;
}

WindowVertex any_vertex(test::Random& random) {
  const auto coordinate = [&] {
    constexpr std::int32_t kOdd[] = {kUnusable, kSnapLimit, -kSnapLimit, kSnapLimit - 1, 0, 256, 255};
    if (random.below(8) == 0) return kOdd[random.below(std::uint32_t(std::size(kOdd)))];
    const double reach = random.below(2) == 0 ? 4000 : kSnapLimit;
    return std::int32_t(random.between(-reach, reach));
  };
  const std::uint32_t outside = random.below(8) == 0 ? 1u << random.below(7) : 0u;
  return {coordinate(), coordinate(), outside, float(random.between(0, 1))};
}

}  // namespace

TEST_CASE("vertices are in the window where each alone is, for every instruction set") {
  test::Random random(21);
  for (const Kernels* kernels : test::kernels_of_machine())
    for (std::size_t count = 0; count <= 40; ++count) {
      std::vector<float> clip(4 * count);
      for (float& c : clip) c = any_component(random);
      const Viewport viewport = make_viewport(640, 400);
      // One more than is written.
      std::vector<WindowVertex> vertices(count + 1, {7, 7, 7, 7}), again = vertices;
      std::vector<WindowPosition> positions(count + 1, {7, 7, 7, 7});
      kernels->transform_vertices({clip.data(), count, viewport, vertices.data(), positions.data()});
      kernels->transform_vertices({clip.data(), count, viewport, again.data(), nullptr});
      CAPTURE(isa_name(kernels->isa));
      for (std::size_t v = 0; v < count; ++v) {
        CAPTURE(v);
        const WindowPosition position = to_window(&clip[4 * v], viewport);
        const WindowVertex expected = snap(position, planes_outside(&clip[4 * v]));
        for (const WindowVertex& found : {vertices[v], again[v]}) {
          REQUIRE(found.x == expected.x);
          REQUIRE(found.y == expected.y);
          REQUIRE(found.outside == expected.outside);
          const float w = clip[4 * v + 3];
          const float depth = w >= 0x1p-24f && w <= 0x1p30f ? position.z : -1.0f;
          REQUIRE((found.depth == depth || (std::isnan(depth) && std::isnan(found.depth))));
        }
        const float a[] = {position.x, position.y, position.z, position.reciprocal_w};
        const float b[] = {positions[v].x, positions[v].y, positions[v].z, positions[v].reciprocal_w};
        for (int i = 0; i < 4; ++i)
          if (!std::isnan(a[i]) || !std::isnan(b[i])) REQUIRE(a[i] == b[i]);
      }
      REQUIRE(vertices[count].x == 7);
      REQUIRE(positions[count].x == 7);
    }
}

TEST_CASE("vertices are snapped to the nearest subpixel, of two the even one, up to a limit") {
  // window = 32 * x + 32; in subpixels 256 * (window - 0.5).
  const std::vector<std::pair<double, std::int32_t>> cases{{0, 0},
                                                           {2.5, 2},
                                                           {3.5, 4},
                                                           {3.25, 3},
                                                           {-2.5, -2},
                                                           {-3.5, -4},
                                                           {8388607, 8388607},
                                                           {-8388607, -8388607},
                                                           {8388608, kUnusable},
                                                           {-8388608, kUnusable}};
  std::vector<float> clip;
  for (const auto& [subpixels, snapped] : cases) {
    const double x = (subpixels / 256 + 0.5 - 32) / 32;
    REQUIRE(double(float(x)) == x);
    clip.insert(clip.end(), {float(x), float(x), 0, 1});
  }
  for (const Kernels* kernels : test::kernels_of_machine()) {
    std::vector<WindowVertex> vertices(cases.size());
    kernels->transform_vertices({clip.data(), cases.size(), {32, 32}, vertices.data(), nullptr});
    for (std::size_t i = 0; i < cases.size(); ++i) {
      CAPTURE(cases[i].first);
      CHECK(vertices[i].x == cases[i].second);
      CHECK(vertices[i].y == cases[i].second);
    }
  }
}

TEST_CASE("triangles are set up exactly, as many as there are, for every instruction set") {
  test::Random random(22);
  for (const Kernels* kernels : test::kernels_of_machine()) {
    std::size_t visible = 0, cut = 0;
    for (int round = 0; round < 4000; ++round) {
      std::vector<WindowVertex> vertices(24);
      for (WindowVertex& v : vertices) v = any_vertex(random);
      const std::uint32_t count = 1 + random.below(kSetUpAtOnce);
      std::vector<std::uint32_t> indices(3 * count);
      for (std::uint32_t& index : indices) index = random.below(std::uint32_t(vertices.size()));
      RasterTriangle triangles[kSetUpAtOnce];
      constexpr std::uint32_t kSizes[] = {1, 800, 1280, 16384};
      const SetUpTriangles call{vertices.data(),         indices.data(),       count,    kSizes[random.below(4)],
                                kSizes[random.below(4)], random.below(2) == 0, triangles};
      const TriangleMasks masks = kernels->set_up_triangles(call);
      CAPTURE(isa_name(kernels->isa));
      CAPTURE(count);
      REQUIRE((masks.visible >> count) == 0);
      REQUIRE((masks.cut >> count) == 0);
      const RasterTriangle* found = triangles;
      for (std::uint32_t k = 0; k < count; ++k) {
        CAPTURE(k);
        const WindowVertex v[3] = {vertices[indices[3 * k]], vertices[indices[3 * k + 1]],
                                   vertices[indices[3 * k + 2]]};
        const std::uint32_t in_any = v[0].outside | v[1].outside | v[2].outside;
        const std::uint32_t in_all = v[0].outside & v[1].outside & v[2].outside;
        const bool is_cut = in_any != 0 && (in_any & kNotFinite) == 0 && in_all == 0;
        REQUIRE((masks.cut >> k & 1) == std::uint32_t(is_cut));
        cut += is_cut;
        RasterTriangle t;
        bool front = false;
        const bool seen = in_any == 0 && expected_triangle(v, call, t, front);
        REQUIRE((masks.visible >> k & 1) == std::uint32_t(seen));
        if (!seen) continue;
        ++visible;
        for (int i = 0; i < 3; ++i) {
          REQUIRE(found->a[i] == t.a[i]);
          REQUIRE(found->b[i] == t.b[i]);
          REQUIRE(found->c[i] == t.c[i]);
        }
        REQUIRE(found->min_x == t.min_x);
        REQUIRE(found->min_y == t.min_y);
        REQUIRE(found->max_x == t.max_x);
        REQUIRE(found->max_y == t.max_y);
        REQUIRE((masks.front >> k & 1) == std::uint32_t(front));
        REQUIRE(found->nearest == t.nearest);
        REQUIRE(found->primitive == 0);
        ++found;
      }
    }
    CHECK(visible > 1000);
    CHECK(cut > 1000);
  }
}
