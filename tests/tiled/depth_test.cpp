// Which fragment stays: the nearest, the first of equals; for shaders that discard or write depth as well.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "raster/tiled/tiled_renderer.h"
#include "tests/tiled/hand_module.h"
#include "tests/tiled/random_scene.h"

using namespace twinshade;

namespace {

// All triangles, each drawn alone, merged by the rule: a fragment replaces what has greater depth.
Frame merged(const Bundle& bundle, const ShaderModule& module, const DrawOptions& options) {
  Bundle one = bundle;
  Frame result;
  for (std::size_t t = 0; t < bundle.triangle_count(); ++t) {
    one.indices.assign(bundle.indices.begin() + std::ptrdiff_t(3 * t),
                       bundle.indices.begin() + std::ptrdiff_t(3 * t + 3));
    const Frame frame = draw_tiled(one, module, options);
    if (t == 0) {
      result = frame;
      continue;
    }
    for (std::size_t p = 0; p < frame.coverage.size(); ++p) {
      if (!frame.coverage[p] || !(frame.depth[p] < result.depth[p])) continue;
      result.coverage[p] = 1;
      result.depth[p] = frame.depth[p];
      result.primitive_id[p] = std::uint32_t(t);
      for (std::size_t c = 0; c < 4; ++c) result.color[4 * p + c] = frame.color[4 * p + c];
    }
  }
  return result;
}

}  // namespace

TEST_CASE("many triangles together are the nearest of each alone") {
  const Bundle bundle = test::torture_bundle(160, 120, 150, 21);
  for (const AttributeMode mode : {AttributeMode::exact, AttributeMode::native})
    for (const ShaderModule* module : {&test::echo_module(), &test::discard_module(), &test::frag_depth_module()}) {
      CAPTURE(module->name);
      CAPTURE(int(mode));
      DrawOptions options;
      options.attributes = mode;
      CHECK(frame_hash(draw_tiled(bundle, *module, options)) == frame_hash(merged(bundle, *module, options)));
    }
}

TEST_CASE("a tile forgets blocks that are hidden, to have room for more, and no others") {
  test::Random random(8);
  Bundle bundle = test::empty_bundle(48, 48);
  for (int i = 0; i < 150; ++i) {  // a tile of 16 pixels has room for what 32 triangles cover
    const float z[3] = {float(random.between(-0.9, 0.9)), float(random.between(-0.9, 0.9)),
                        float(random.between(-0.9, 0.9))};
    const float all[12] = {-1, -1, z[0], 1, 3, -1, z[1] * 2 - z[0], 1, -1, 3, z[2] * 2 - z[0], 1};
    test::add_triangle(bundle, all, random);
  }
  test::finish(bundle);
  DrawOptions options;
  options.tile_size = 16;
  for (const AttributeMode mode : {AttributeMode::exact, AttributeMode::native})
    for (const ShaderModule* module : {&test::echo_module(), &test::derivatives_module()}) {
      options.attributes = mode;
      const Frame frame = draw_tiled(bundle, *module, options);
      CHECK(frame_hash(frame) == frame_hash(merged(bundle, *module, options)));
      const std::set<std::uint32_t> ids(frame.primitive_id.begin(), frame.primitive_id.end());
      CHECK(ids.size() > 5);
    }
}

TEST_CASE("of equal depths the first primitive stays") {
  test::Random random(5);
  Bundle bundle = test::empty_bundle(40, 40);
  const float full[12] = {-1, -1, 0.25f, 1, 3, -1, 0.25f, 1, -1, 3, 0.25f, 1};
  for (int i = 0; i < 5; ++i) test::add_triangle(bundle, full, random);
  test::finish(bundle);
  for (const ShaderModule* module : {&test::echo_module(), &test::frag_depth_module()}) {
    if (module == &test::frag_depth_module()) bundle.attributes[0].values.assign(5 * 12, 0.75f);
    const Frame frame = draw_tiled(bundle, *module, {});
    for (const std::uint32_t id : frame.primitive_id) REQUIRE(id == 0);
  }
}

TEST_CASE("a discarded fragment hides nothing") {
  test::Random random(6);
  Bundle bundle = test::empty_bundle(40, 40);
  const float near_by[12] = {-1, -1, -0.5f, 1, 3, -1, -0.5f, 1, -1, 3, -0.5f, 1};
  const float far_off[12] = {-1, -1, 0.5f, 1, 3, -1, 0.5f, 1, -1, 3, 0.5f, 1};
  test::add_triangle(bundle, near_by, random);
  test::add_triangle(bundle, far_off, random);
  test::finish(bundle);
  bundle.attributes[0].values.assign(24, 1.0f);
  for (std::size_t v = 0; v < 3; ++v) bundle.attributes[0].values[4 * v] = 0;  // the near one
  const Frame frame = draw_tiled(bundle, test::discard_module(), {});
  for (const std::uint32_t id : frame.primitive_id) REQUIRE(id == 1);
  for (const float depth : frame.depth) REQUIRE(depth == 0.75f);
}

TEST_CASE("written depth is clamped, and NaN is nearer than nothing") {
  test::Random random(7);
  for (const auto& [written, expected] : {std::pair{-3.0f, 0.0f}, {NAN, 1.0f}, {0.3f, 0.3f}, {1.5f, 1.0f}}) {
    Bundle bundle = test::empty_bundle(8, 8);
    const float full[12] = {-1, -1, 0, 1, 3, -1, 0, 1, -1, 3, 0, 1};
    test::add_triangle(bundle, full, random);
    test::finish(bundle);
    bundle.attributes[0].values.assign(12, written);
    const Frame frame = draw_tiled(bundle, test::frag_depth_module(), {});
    for (const float depth : frame.depth) CHECK(depth == doctest::Approx(expected).epsilon(1e-6));
    CHECK(frame.coverage[9] == (expected < 1));  // 1 is not less than the cleared 1
  }
}

TEST_CASE("side effects happen for every covered pixel, in primitive order, hidden or not") {
  // Three full-screen triangles, nearest first, in one tile: the counter counts hidden pixels too.
  test::Random random(8);
  Bundle bundle = test::empty_bundle(16, 16);
  for (const float z : {-0.9f, 0.0f, 0.9f, -0.95f}) {
    const float full[12] = {-1, -1, z, 1, 3, -1, z, 1, -1, 3, z, 1};
    test::add_triangle(bundle, full, random);
  }
  test::finish(bundle);
  bundle.buffers.push_back({"counter", true, std::vector<std::byte>(4)});
  const Frame frame = draw_tiled(bundle, test::side_effect_module(), {});
  for (const std::uint32_t id : frame.primitive_id) REQUIRE(id == 3);
  CHECK(frame.color[0] == 3 * 256);
  CHECK(bundle.buffers[0].bytes[0] == std::byte{0});  // the bundle's own stays as it was
}

TEST_CASE("whole primitives and those that are cut have their side effects in their order") {
  constexpr std::size_t kCount = 37;  // two groups that are set up at once, and a part of a third
  const auto is_cut = [](std::size_t i) { return i % 3 == 1; };
  const auto scene = [&](std::size_t begin, std::size_t end, std::size_t nearest) {
    test::Random random(9);
    Bundle bundle = test::empty_bundle(16, 16);
    for (std::size_t i = begin; i < end; ++i) {
      const float z = i == nearest ? -0.5f : 0.5f, reach = is_cut(i) ? 3.0f : 1.0f;
      const float corner[12] = {-1, -1, z, 1, reach, -1, z, 1, -1, reach, z, 1};
      test::add_triangle(bundle, corner, random);
    }
    test::finish(bundle);
    bundle.buffers.push_back({"counter", true, std::vector<std::byte>(4)});
    return bundle;
  };
  const auto pixels_of = [&](std::size_t i) {
    const Frame alone = draw_tiled(scene(i, i + 1, i), test::side_effect_module(), {});
    return std::count(alone.coverage.begin(), alone.coverage.end(), std::uint8_t{1});
  };
  const std::ptrdiff_t whole = pixels_of(0), cut = pixels_of(1);
  REQUIRE(whole < cut);
  std::ptrdiff_t before = 0;
  for (std::size_t nearest = 0; nearest < kCount; ++nearest) {
    const Frame frame = draw_tiled(scene(0, kCount, nearest), test::side_effect_module(), {});
    REQUIRE(frame.primitive_id[0] == nearest);
    REQUIRE(frame.color[0] == float(before));
    before += is_cut(nearest) ? cut : whole;
  }
}

TEST_CASE("native depth and inputs are close to the exact ones where the triangle is not extreme") {
  const Bundle bundle = test::inside_bundle(256, 128, 300, 23);
  DrawOptions options;
  options.capture_attributes = true;
  const Frame exact = draw_tiled(bundle, test::echo_module(), options);
  options.attributes = AttributeMode::native;
  const Frame native = draw_tiled(bundle, test::echo_module(), options);
  CHECK(exact.coverage == native.coverage);
  std::size_t same_id = 0, covered = 0, far_off = 0;
  const std::size_t pixels = exact.coverage.size();
  for (std::size_t p = 0; p < pixels; ++p) {
    if (!exact.coverage[p]) continue;
    ++covered;
    if (exact.primitive_id[p] != native.primitive_id[p]) continue;
    ++same_id;
    far_off += std::fabs(exact.depth[p] - native.depth[p]) > 1e-3f;
    for (std::size_t c = 0; c < 4; ++c)
      far_off += std::fabs(exact.attributes[c * pixels + p] - native.attributes[c * pixels + p]) > 5e-3f;
  }
  CHECK(covered > 5000);
  CHECK(same_id > covered * 99 / 100);
  CHECK(far_off < covered / 100);
}
