// Coverage against a brute-force twin in wide integers, and the properties a fill rule is for.
#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

#include "raster/tiled/tiled_renderer.h"
#include "raster/tiled/window.h"
#include "tests/tiled/hand_module.h"
#include "tests/tiled/machine_kernels.h"
#include "tests/tiled/random_scene.h"

using namespace twinshade;

namespace {

__extension__ using Wide = __int128;

struct Snapped {
  Wide x[3], y[3];
};

Snapped snapped_positions(const Bundle& bundle, std::size_t triangle) {
  const tiled::Viewport viewport = tiled::make_viewport(bundle.width, bundle.height);
  Snapped s;
  for (std::size_t v = 0; v < 3; ++v) {
    const tiled::WindowPosition p =
        tiled::to_window(&bundle.clip_positions[bundle.indices[3 * triangle + v] * 4], viewport);
    s.x[v] = Wide(std::nearbyint(double((p.x - 0.5f) * 256.0f)));
    s.y[v] = Wide(std::nearbyint(double((p.y - 0.5f) * 256.0f)));
  }
  return s;
}

// A point on an edge belongs to the side it falls on when it is moved by (epsilon, epsilon^2): the sign of the edge
// function, then of its x derivative, then of its y derivative.
int side(Wide x0, Wide y0, Wide x1, Wide y1, Wide px, Wide py) {
  const Wide value = (x1 - x0) * (py - y0) - (y1 - y0) * (px - x0);
  const Wide dx = -(y1 - y0), dy = x1 - x0;
  for (const Wide sign : {value, dx, dy})
    if (sign != 0) return sign > 0 ? 1 : -1;
  return 0;
}

bool covers(const Snapped& s, int x, int y) {
  const Wide px = Wide(x) * 256, py = Wide(y) * 256;
  int sum = 0;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const int edge = side(s.x[i], s.y[i], s.x[j], s.y[j], px, py);
    if (edge == 0) return false;
    sum += edge;
  }
  return sum == 3 || sum == -3;
}

Bundle one_triangle(const Bundle& bundle, std::size_t triangle) {
  Bundle one = bundle;
  one.indices.assign(bundle.indices.begin() + std::ptrdiff_t(3 * triangle),
                     bundle.indices.begin() + std::ptrdiff_t(3 * triangle + 3));
  return one;
}

}  // namespace

TEST_CASE("coverage is that of wide integers, pixel by pixel") {
  for (const auto& [width, height] : {std::pair{64u, 48u}, {33u, 129u}, {500u, 20u}}) {
    const Bundle bundle = test::inside_bundle(width, height, 400, width);
    std::size_t covered = 0, on_edges = 0;
    for (std::size_t t = 0; t < bundle.triangle_count(); ++t) {
      const Bundle one = one_triangle(bundle, t);
      DrawOptions options;
      options.tile_size = t % 2 ? 16 : 64;
      const Frame frame = draw_tiled(one, test::echo_module(), options);
      const Snapped s = snapped_positions(bundle, t);
      std::size_t different = 0;
      for (std::uint32_t y = 0; y < height; ++y)
        for (std::uint32_t x = 0; x < width; ++x) {
          const bool expected = covers(s, int(x), int(y));
          different += bool(frame.coverage[y * width + x]) != expected;
          covered += expected;
          for (int i = 0; i < 3; ++i) {
            const int j = (i + 1) % 3;
            on_edges += (s.x[j] - s.x[i]) * (Wide(y) * 256 - s.y[i]) == (s.y[j] - s.y[i]) * (Wide(x) * 256 - s.x[i]);
          }
        }
      CAPTURE(t);
      CHECK(different == 0);
    }
    CHECK(covered > 1000);
    CHECK(on_edges > 250);  // the rule was put to the test
  }
}

// Edge functions of the largest frame have more than 32 bits.
TEST_CASE("tiles of frames of any size are covered as wide integers say, for every instruction set") {
  constexpr std::uint32_t kLargest = 16384;
  test::Random random(5);
  std::size_t covered = 0, tiles = 0, at_border = 0;
  while (tiles < 600) {
    const bool largest = random.below(2) == 0;
    const std::uint32_t width = largest ? kLargest : 1 + random.below(kLargest),
                        height = largest ? kLargest : 1 + random.below(kLargest);
    tiled::WindowVertex corners[3];  // in subpixels
    float clip[12];
    for (std::size_t v = 0; v < 3; ++v) {
      const auto coordinate = [&](std::uint32_t size) {  // one in four at the far border
        return std::int32_t(random.below(4) == 0 ? size * 256 - 1 : random.below(size * 256));
      };
      corners[v] = {coordinate(width), coordinate(height), 0, 0};
      const double w = std::exp2(random.between(-3, 3));
      const float at[] = {float(((corners[v].x / 256.0 + 0.5) * 2 / width - 1) * w),
                          float(((corners[v].y / 256.0 + 0.5) * 2 / height - 1) * w), float(random.between(-1, 1) * w),
                          float(w)};
      std::copy_n(at, 4, clip + 4 * v);
    }
    constexpr std::uint32_t kInOrder[] = {0, 1, 2};
    const std::uint32_t size = 16u << random.below(4);
    const bool last = random.below(2) == 0;
    const std::uint32_t x0 = (last ? width - 1 : random.below(width)) / size * size,
                        y0 = random.below(height) / size * size;
    for (const tiled::Kernels* kernels : test::kernels_of_machine()) {
      CAPTURE(tiled::isa_name(kernels->isa));
      tiled::RasterTriangle triangles[tiled::kSetUpAtOnce];
      if (kernels->set_up_triangles({corners, kInOrder, 1, width, height, false, triangles}).visible == 0) break;
      const tiled::RasterTriangle* triangle = &triangles[0];
      if (triangle->min_x >= x0 + size || triangle->max_x < x0 || triangle->min_y >= y0 + size || triangle->max_y < y0)
        break;  // it is in no other tile's bin
      if (kernels->isa == Isa::baseline) {
        ++tiles;
        at_border += x0 + size > width || y0 + size > height;
      }
      const std::uint32_t local = 0;
      const tiled::LocalPrimitive primitive{0, nullptr, nullptr};
      const tiled::TriangleGroup group{triangle->nearest, 0};
      const tiled::VertexData vertices{clip, kInOrder, nullptr, 0, 2.0f / float(width), 2.0f / float(height)};
      std::vector<float> farthest(tiled::kFarthestRoom, 1.0f), depth(size * size, 1.0f), depths(size * size + 16);
      std::vector<std::uint32_t> visible(size * size, tiled::kNotVisible);
      std::vector<tiled::VisibleBlock> blocks(size * size / 16 + 1), covered_blocks(tiled::kBlockRoom * size * size);
      const tiled::CoverTile tile{&triangle,
                                  &local,
                                  1,
                                  &group,
                                  1,
                                  &primitive,
                                  &vertices,
                                  x0,
                                  y0,
                                  size,
                                  width,
                                  height,
                                  depth.data(),
                                  visible.data(),
                                  farthest.data(),
                                  covered_blocks.data()};
      kernels->cover(tile);
      const std::uint32_t block_count = kernels->cover_one(tile, 0, false, blocks.data(), depths.data());
      std::vector<std::uint32_t> block_of(size * size / 16, block_count);
      for (std::uint32_t i = 0; i < block_count; ++i) block_of[blocks[i].block] = i;
      std::size_t different = 0, depths_different = 0;
      for (std::uint32_t k = 0; k < size * size; ++k) {
        // kernels.h: the order of pixels in a tile's memory.
        const std::uint32_t superblock = k / 256, across = size / 16;
        const Wide x = x0 + superblock % across * 16 + (k / 16 % 4) * 4 + (k / 4 % 2) * 2 + k % 2;
        const Wide y = y0 + superblock / across * 16 + (k / 64 % 4) * 4 + (k / 8 % 2) * 2 + k / 2 % 2;
        bool expected = x < width && y < height;
        for (int e = 0; e < 3; ++e)
          expected = expected && triangle->c[e] + triangle->a[e] * x + triangle->b[e] * y >= 0;
        const std::uint32_t block = block_of[k / 16];
        const bool inside = block < block_count && (blocks[block].coverage >> k % 16 & 1) != 0;
        different += inside != expected;
        covered += expected;
        // Both ways the same depth; at 1 nothing is nearer than what is there.
        const float here = inside ? depths[16 * block + k % 16] : 1.0f;
        depths_different += std::bit_cast<std::uint32_t>(depth[k]) != std::bit_cast<std::uint32_t>(here);
        depths_different += (visible[k] == 0) != (here < 1);
      }
      CHECK(different == 0);
      CHECK(depths_different == 0);
    }
  }
  CHECK(covered > 100000);
  CHECK(at_border > 100);
}

TEST_CASE("a mesh that tiles the screen covers each pixel exactly once") {
  constexpr std::uint32_t kSize = 48, kCells = 6;
  for (std::uint64_t seed = 1; seed <= 25; ++seed) {
    CAPTURE(seed);
    test::Random random(seed);
    float grid[kCells + 1][kCells + 1][2];
    // Odd seeds: inner vertices on half pixels, where many pixel centres lie exactly on edges; some cells degenerate.
    for (std::uint32_t j = 0; j <= kCells; ++j)
      for (std::uint32_t i = 0; i <= kCells; ++i)
        for (std::uint32_t c = 0; c < 2; ++c) {
          const std::uint32_t k = c == 0 ? i : j;
          double at = k * 8.0;
          if (k != 0 && k != kCells) at += seed % 2 ? double(random.below(9)) / 2 - 2 : random.between(-2.6, 2.6);
          grid[j][i][c] = float(at * 2 / kSize - 1);
        }
    std::vector<int> count(kSize * kSize);
    for (std::uint32_t j = 0; j < kCells; ++j)
      for (std::uint32_t i = 0; i < kCells; ++i)
        for (int half = 0; half < 2; ++half) {
          const std::uint32_t corner[2][3][2] = {{{0, 0}, {1, 0}, {1, 1}}, {{0, 0}, {1, 1}, {0, 1}}};
          const bool reversed = random.below(2) != 0;
          float p[12];
          for (std::uint32_t v = 0; v < 3; ++v) {
            const auto& at = grid[j + corner[half][v][1]][i + corner[half][v][0]];
            const float w = float(1 << random.below(3));  // exact: the point on the screen stays the same
            float* out = p + 4 * (reversed ? 2 - v : v);
            out[0] = at[0] * w;
            out[1] = at[1] * w;
            out[2] = 0;
            out[3] = w;
          }
          Bundle bundle = test::empty_bundle(kSize, kSize);
          test::add_triangle(bundle, p, random);
          test::finish(bundle);
          const Frame frame = draw_tiled(bundle, test::echo_module(), {});
          for (std::size_t pixel = 0; pixel < count.size(); ++pixel) count[pixel] += frame.coverage[pixel];
        }
    std::size_t wrong = 0;
    for (const int times : count) wrong += times != 1;
    CHECK(wrong == 0);
  }
}

TEST_CASE("a reversed triangle covers the same pixels and faces the other way") {
  const Bundle bundle = test::inside_bundle(200, 150, 60, 7);
  Bundle reversed = bundle;
  for (std::size_t t = 0; t < bundle.triangle_count(); ++t)
    std::swap(reversed.indices[3 * t], reversed.indices[3 * t + 1]);
  for (const AttributeMode mode : {AttributeMode::exact, AttributeMode::native}) {
    DrawOptions options;
    options.attributes = mode;
    for (std::size_t t = 0; t < bundle.triangle_count(); ++t) {
      const Frame a = draw_tiled(one_triangle(bundle, t), test::built_ins_module(), options);
      const Frame b = draw_tiled(one_triangle(reversed, t), test::built_ins_module(), options);
      REQUIRE(a.coverage == b.coverage);
      std::size_t same_face = 0;
      for (std::size_t p = 0; p < a.coverage.size(); ++p)
        same_face += a.coverage[p] && a.color[4 * p + 2] == b.color[4 * p + 2];
      CHECK(same_face == 0);
      Bundle culled = one_triangle(bundle, t), other = one_triangle(reversed, t);
      culled.cull_back_faces = other.cull_back_faces = true;
      const Frame c = draw_tiled(culled, test::built_ins_module(), options);
      const Frame d = draw_tiled(other, test::built_ins_module(), options);
      std::size_t covered = 0, left = 0;
      for (std::size_t p = 0; p < a.coverage.size(); ++p) {
        covered += a.coverage[p];
        left += std::size_t(c.coverage[p] + d.coverage[p]);
      }
      CHECK(left == covered);
    }
  }
}

TEST_CASE("positions that are not finite drop their triangle and nothing else") {
  const Bundle bundle = test::inside_bundle(120, 90, 40, 9);
  for (const float bad : {NAN, INFINITY, -INFINITY})
    for (int component = 0; component < 4; ++component) {
      Bundle damaged = bundle, without = bundle;
      for (std::size_t t = 0; t < bundle.triangle_count(); t += 3) {
        damaged.clip_positions[4 * damaged.indices[3 * t + t % 3] + std::size_t(component)] = bad;
        for (int v = 0; v < 3; ++v) without.indices[3 * t + std::size_t(v)] = without.indices[3 * t];
      }
      CHECK(frame_hash(draw_tiled(damaged, test::echo_module(), {})) ==
            frame_hash(draw_tiled(without, test::echo_module(), {})));
    }
}

TEST_CASE("a frame without triangles is clear, and one pixel is a frame") {
  Bundle bundle = test::empty_bundle(1, 1);
  Frame frame = draw_tiled(bundle, test::echo_module(), {});
  CHECK(frame.coverage[0] == 0);
  CHECK(frame.depth[0] == 1);
  CHECK(frame.primitive_id[0] == kNoPrimitive);
  test::Random random(1);
  const float full[12] = {-1, -1, 0, 1, 3, -1, 0, 1, -1, 3, 0, 1};
  test::add_triangle(bundle, full, random);
  frame = draw_tiled(bundle, test::echo_module(), {});
  CHECK(frame.coverage[0] == 1);
  CHECK(frame.depth[0] == 0.5f);
  CHECK(frame.primitive_id[0] == 0);
}
