// What is left out because it is hidden: never what would show.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "raster/tiled/kernels.h"
#include "raster/tiled/tiled_renderer.h"
#include "tests/tiled/hand_module.h"
#include "tests/tiled/machine_kernels.h"
#include "tests/tiled/random_scene.h"

using namespace twinshade;
using namespace twinshade::tiled;

namespace {

constexpr std::uint32_t kTile = 128;

struct Corners {
  float clip[12];
};

// A triangle about some place of the frame, in normalised device coordinates, up to a tile across, often thin; depths
// and w of any ratio.
Corners any_corners(test::Random& random, std::uint32_t width, std::uint32_t height) {
  const double pixel_x = 2.0 / width, pixel_y = 2.0 / height;
  const double reach = std::exp2(random.between(0, 7)), thickness = std::exp2(random.between(-4, 7));
  const double angle = random.between(0, 6.2831853);
  const double ratio = random.between(0, 12), center_w = std::exp2(random.between(-12, 18));
  const double center_x = random.between(-1, 1), center_y = random.between(-1, 1);
  const bool far_corner = random.below(3) == 0;
  const double depth = random.between(-1, 1), depth_range = std::exp2(random.between(-20, 0));
  Corners corners;
  for (int v = 0; v < 3; ++v) {
    const double along = random.between(-0.5, 0.5) * reach, across = random.between(-0.5, 0.5) * thickness;
    const double px = along * std::cos(angle) - across * std::sin(angle);
    const double py = along * std::sin(angle) + across * std::cos(angle);
    const double x = std::clamp((far_corner ? 1 - reach * pixel_x : center_x) + px * pixel_x, -1.0, 1.0);
    const double y = std::clamp((far_corner ? 1 - reach * pixel_y : center_y) + py * pixel_y, -1.0, 1.0);
    const double w = center_w * std::exp2(random.between(-ratio, ratio));
    const double z = std::clamp(depth + random.between(-1, 1) * depth_range, -1.0, 1.0);
    const float at[] = {float(x * w), float(y * w), float(z * w), float(w)};
    std::copy_n(at, 4, corners.clip + 4 * v);
  }
  return corners;
}

}  // namespace

// docs/raster-rule.md derives the bound; here is how much of it is used up at most.
TEST_CASE("no pixel of a triangle is nearer than its setup says") {
  test::Random random(31);
  const Kernels& kernels = *test::kernels_of_machine().back();
  constexpr std::uint32_t kIndices[] = {0, 1, 2};
  std::size_t pixels = 0, bounded = 0, unbounded = 0;
  double most = 0;
  while (bounded < 30000) {
    const std::uint32_t width = 1u << (7 + random.below(8)), height = 1u << (7 + random.below(8));
    const Corners corners = any_corners(random, width, height);
    WindowVertex window[3];
    WindowPosition positions[3];
    const Viewport viewport = make_viewport(width, height);
    kernels.transform_vertices({corners.clip, 3, viewport, window, positions});
    RasterTriangle triangles[kSetUpAtOnce];
    const TriangleMasks masks = kernels.set_up_triangles({window, kIndices, 1, width, height, false, triangles});
    if (masks.visible == 0) continue;
    const RasterTriangle& t = triangles[0];
    if (t.nearest < 0) {
      ++unbounded;
      continue;
    }
    ++bounded;
    const bool front = masks.front != 0;
    const NativeTriangle native_triangle{
        {positions[front ? 0 : 1], positions[front ? 1 : 0], positions[2]}, {0, 1, 2}, 0};
    const RasterTriangle* const triangle = &t;
    const std::uint32_t local = 0;
    const TriangleGroup group{t.nearest, 0};
    const VertexData vertices{corners.clip, kIndices, nullptr, 0, 2.0f / float(width), 2.0f / float(height)};
    const auto [near, far] = std::minmax({window[0].depth, window[1].depth, window[2].depth});
    for (const NativeTriangle* native : {static_cast<const NativeTriangle*>(nullptr), &native_triangle}) {
      const LocalPrimitive primitive{0, native, nullptr};
      std::vector<VisibleBlock> blocks(kTile * kTile / 16 + 1);
      std::vector<float> depths(kTile * kTile + 16);
      for (std::uint32_t y = t.min_y / kTile * kTile; y <= t.max_y; y += kTile)
        for (std::uint32_t x = t.min_x / kTile * kTile; x <= t.max_x; x += kTile) {
          std::vector<float> farthest(kFarthestRoom, 1.0f);
          const CoverTile tile{&triangle, &local, 1,     &group, 1,       &primitive, &vertices,       x,
                               y,         kTile,  width, height, nullptr, nullptr,    farthest.data(), nullptr};
          const std::uint32_t count = kernels.cover_one(tile, 0, false, blocks.data(), depths.data());
          for (std::uint32_t b = 0; b < count; ++b)
            for (std::uint32_t k = 0; k < 16; ++k) {
              if ((blocks[b].coverage >> k & 1) == 0) continue;
              const float depth = depths[16 * b + k];
              ++pixels;
              if (!(depth > t.nearest)) {
                std::string input;
                for (const float c : corners.clip) input += fmt::format(" {:a}", c);
                FAIL(fmt::format("{}x{}, {}: {:a} is not more than {:a}:{}", width, height, native ? "native" : "exact",
                                 depth, t.nearest, input));
              }
              most = std::max(most, (double(near) - double(depth)) / (double(near) - double(t.nearest)));
            }
        }
    }
  }
  CHECK(pixels > 1000000);
  CHECK(unbounded > 1000);
  MESSAGE("of the bound used up: ", most);
  CHECK(most < 0.5);
}

TEST_CASE("of equal depths the first primitive stays, whatever is covered first") {
  constexpr std::uint32_t kLayers = 5 * kTrianglesTogether;
  const auto full = [](float z) { return Corners{{-1, -1, z, 1, 3, -1, z, 1, -1, 3, z, 1}}; };
  for (const bool inside : {false, true}) {  // triangles that are cut are not bounded
    test::Random random(32);
    Bundle bundle = test::empty_bundle(40, 40);
    for (std::uint32_t i = 0; i < kLayers; ++i) {
      Corners c = full(0.25f);
      if (inside) c = {{-1, -1, 0.25f, 1, 1, -1, 0.25f, 1, -1, 1, 0.25f, 1}};
      test::add_triangle(bundle, c.clip, random);
      // In a corner something is nearer, the more so the later: groups are covered from the last one on.
      const float z = -float(i) / float(kLayers);
      const float corner[12] = {-1, -1, z, 1, -0.8f, -1, z, 1, -1, -0.8f, z, 1};
      test::add_triangle(bundle, corner, random);
    }
    test::finish(bundle);
    for (float& value : bundle.attributes[0].values) value = 1;  // no fragment is discarded
    for (const ShaderModule* module : {&test::echo_module(), &test::discard_module()})
      for (const AttributeMode mode : {AttributeMode::exact, AttributeMode::native}) {
        DrawOptions options;
        options.attributes = mode;
        const Frame frame = draw_tiled(bundle, *module, options);
        std::size_t first = 0;
        for (std::size_t p = 0; p < frame.coverage.size(); ++p) {
          if (!frame.coverage[p]) continue;
          const bool last_corner = frame.primitive_id[p] == 2 * kLayers - 1;
          REQUIRE((frame.primitive_id[p] == 0 || last_corner));
          first += frame.primitive_id[p] == 0;
        }
        CHECK(first > 700);
      }
  }
}

TEST_CASE("layers behind what covers a tile are not covered, in whatever order they come") {
  test::Random random(33);
  constexpr std::uint32_t kLayers = 64 * kTrianglesTogether;
  for (const bool farthest_first : {false, true}) {
    std::vector<float> clip;
    std::vector<std::uint32_t> indices, locals;
    for (std::uint32_t i = 0; i < kLayers; ++i) {
      const float z = -0.9f + 1.8f * float(farthest_first ? kLayers - i : i) / float(kLayers);
      // Two cover the tile's 128 pixels of 128.
      const float corners[12] = {-1, -1, z, 1, 1, -1, z, 1, i % 2 ? -1.0f : 1.0f, 1, z, 1};
      const float other[12] = {-1, -1, z, 1, 1, 1, z, 1, -1, 1, z, 1};
      const float* const from = i % 2 ? other : corners;
      clip.insert(clip.end(), from, from + 12);
      for (std::uint32_t v = 0; v < 3; ++v) indices.push_back(3 * i + v);
      locals.push_back(i);
    }
    for (const Kernels* kernels : test::kernels_of_machine()) {
      CAPTURE(isa_name(kernels->isa));
      std::vector<WindowVertex> window(3 * kLayers);
      kernels->transform_vertices({clip.data(), window.size(), make_viewport(kTile, kTile), window.data(), nullptr});
      std::vector<RasterTriangle> triangles(kLayers);
      std::vector<const RasterTriangle*> pointers;
      std::vector<LocalPrimitive> primitives;
      std::vector<TriangleGroup> groups;
      for (std::uint32_t i = 0; i < kLayers; i += kSetUpAtOnce)
        REQUIRE(
            kernels
                ->set_up_triangles({window.data(), &indices[3 * i], kSetUpAtOnce, kTile, kTile, false, &triangles[i]})
                .visible == 0xffffu);
      for (std::uint32_t i = 0; i < kLayers; ++i) {
        triangles[i].primitive = i;
        pointers.push_back(&triangles[i]);
        primitives.push_back({i, nullptr, nullptr});
        if (i % kTrianglesTogether == 0) groups.push_back({2, i});
        groups.back().nearest = std::min(groups.back().nearest, triangles[i].nearest);
      }
      std::sort(groups.begin(), groups.end(), [](auto a, auto b) { return a.nearest < b.nearest; });
      const VertexData vertices{clip.data(), indices.data(), nullptr, 0, 2.0f / kTile, 2.0f / kTile};
      std::vector<float> depth(kTile * kTile, 1.0f), farthest(kFarthestRoom, 1.0f);
      std::vector<std::uint32_t> visible(kTile * kTile, kNotVisible);
      std::vector<VisibleBlock> blocks(kBlockRoom * kTile * kTile);
      const CoverTile tile{pointers.data(),
                           locals.data(),
                           kLayers,
                           groups.data(),
                           std::uint32_t(groups.size()),
                           primitives.data(),
                           &vertices,
                           0,
                           0,
                           kTile,
                           kTile,
                           kTile,
                           depth.data(),
                           visible.data(),
                           farthest.data(),
                           blocks.data()};
      const std::uint32_t count = kernels->cover(tile);
      // All blocks once, those on the diagonal twice, of each of the first group's four pairs in its own order.
      CHECK(count <= kTrianglesTogether / 2 * (1024 + 32));
      const std::uint32_t nearest = farthest_first ? kLayers - 1 : 0;
      for (const std::uint32_t v : visible) REQUIRE(v / 2 == nearest / 2);
    }
  }
}
