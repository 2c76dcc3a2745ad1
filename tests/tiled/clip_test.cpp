// Clipping: what is left is inside, where it was, and all there.
#include <doctest/doctest.h>

#include <cmath>

#include "raster/tiled/clip.h"
#include "raster/tiled/kernels.h"
#include "raster/tiled/tiled_renderer.h"
#include "raster/tiled/window.h"
#include "tests/tiled/hand_module.h"
#include "tests/tiled/random_scene.h"

using namespace twinshade;

namespace {

void random_positions(float (&p)[12], test::Random& random, double reach) {
  for (float& c : p) c = float(random.between(-reach, reach));
  for (int v = 0; v < 3; ++v)
    if (random.below(3) != 0) p[4 * v + 3] = float(random.between(0.1, reach));
}

std::uint32_t outside(const float (&p)[12]) {
  tiled::WindowVertex v[3];
  tiled::choose_kernels(Isa::baseline, Number::lanes4).transform_vertices({p, 3, {32, 32}, v, nullptr});
  return v[0].outside | v[1].outside | v[2].outside;
}

}  // namespace

TEST_CASE("a clipped polygon lies within the view volume and on the triangle's plane") {
  test::Random random(11);
  int cut = 0;
  for (int i = 0; i < 20000; ++i) {
    float p[12];
    random_positions(p, random, 2);
    const tiled::ClippedTriangle clipped = tiled::clip_triangle(p, outside(p));
    if (clipped.count < 3) continue;
    cut += clipped.added_count > 0;
    for (int k = 0; k < clipped.count; ++k) {
      const std::uint8_t number = clipped.polygon[std::size_t(k)];
      const float* v = number < 3 ? p + 4 * number : clipped.added[number - 3].position;
      for (int c = 0; c < 3; ++c) REQUIRE(std::fabs(v[c]) <= v[3] + 1e-5f);
      // On the hyperplane through the three vertices: barycentric weights reproduce it.
      double weight[3] = {0, 0, 0};
      if (number < 3) {
        weight[number] = 1;
      } else {
        std::array<std::array<double, 3>, 16> weights{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
        for (int n = 0; n <= number - 3; ++n) {
          const tiled::NewVertex& added = clipped.added[std::size_t(n)];
          REQUIRE(added.t >= 0);
          REQUIRE(added.t <= 0.5f);  // from the nearer end
          for (std::size_t w = 0; w < 3; ++w)
            weights[std::size_t(n + 3)][w] =
                weights[added.from][w] + double(added.t) * (weights[added.to][w] - weights[added.from][w]);
        }
        for (std::size_t w = 0; w < 3; ++w) weight[w] = weights[number][w];
      }
      for (int c = 0; c < 4; ++c)
        REQUIRE(v[c] == doctest::Approx(weight[0] * p[c] + weight[1] * p[4 + c] + weight[2] * p[8 + c]).epsilon(1e-5));
    }
  }
  CHECK(cut > 5000);
}

TEST_CASE("a triangle in parts of the view volume is drawn where homogeneous coordinates say") {
  constexpr std::uint32_t kSize = 64;
  test::Random random(12);
  std::size_t covered = 0, behind = 0, tested = 0;
  for (int i = 0; i < 1500; ++i) {
    float p[12];
    random_positions(p, random, i % 2 ? 2 : 8);
    if (outside(p) == 0) continue;
    Bundle bundle = test::empty_bundle(kSize, kSize);
    test::add_triangle(bundle, p, random);
    const Frame frame = draw_tiled(bundle, test::echo_module(), {});
    behind += p[3] < 0 || p[7] < 0 || p[11] < 0;
    std::size_t wrong = 0;
    for (std::uint32_t y = 0; y < kSize; ++y)
      for (std::uint32_t x = 0; x < kSize; ++x) {
        const double nx = (x + 0.5) * 2 / kSize - 1, ny = (y + 0.5) * 2 / kSize - 1;
        double e[3], clearance = 1e9, sum = 0, z = 0, w = 0;
        for (int v = 0; v < 3; ++v) {
          const float* a = p + 4 * ((v + 1) % 3);
          const float* b = p + 4 * ((v + 2) % 3);
          const double ax = a[0] - nx * a[3], ay = a[1] - ny * a[3], bx = b[0] - nx * b[3], by = b[1] - ny * b[3];
          e[v] = ax * by - bx * ay;
          const double slope_x = double(a[1]) * b[3] - double(b[1]) * a[3];
          const double slope_y = double(b[0]) * a[3] - double(a[0]) * b[3];
          clearance = std::min(clearance, std::fabs(e[v]) / std::hypot(slope_x, slope_y) * kSize / 2);
          sum += e[v];
          z += e[v] * p[4 * v + 2];
          w += e[v] * p[4 * v + 3];
        }
        const double depth = z / w;
        // Too close to an edge or to the near or far plane for subpixels to tell.
        if (clearance < 0.05 || std::fabs(std::fabs(depth) - 1) < 0.02) continue;
        const bool same_side = (e[0] > 0) == (e[1] > 0) && (e[1] > 0) == (e[2] > 0);
        const bool visible = same_side && w / sum > 0 && std::fabs(depth) < 1;
        wrong += visible != bool(frame.coverage[y * kSize + x]);
        covered += visible;
        ++tested;
      }
    CAPTURE(i);
    CHECK(wrong == 0);
  }
  CHECK(covered > 20000);
  CHECK(behind > 300);
  CHECK(tested > 1000000);
}

TEST_CASE("infinite distances leave nothing") {
  const float p[12] = {0, 0, 0, 1, INFINITY, 0, 0, 1, 0, 2, 0, 1};
  CHECK(tiled::clip_triangle(p, tiled::kClipRight | tiled::kClipTop).count == 0);
  const float q[12] = {0, 0, 0, 1, 3e38f, 0, 0, -3e38f, 0, 2, 0, 1};
  CHECK(tiled::clip_triangle(q, tiled::kClipRight | tiled::kClipTop).count == 0);
}
