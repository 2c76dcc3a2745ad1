#include "lighting/texel_coverage.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "lighting/random.h"

namespace twinshade {
namespace {

using glm::dvec2;

constexpr std::uint32_t kNobody = TexelOwner().triangle;

// How far the triangle reaches into a texel's square: the least overlap across any side of one or the other, in texels;
// below 0 where a side parts them (separating axes).
double reach(const dvec2* p, const dvec2& square) {
  double least = 1e9;
  for (int k = 0; k < 3; ++k) {
    const dvec2 along = p[(k + 1) % 3] - p[k], opposite = p[(k + 2) % 3] - p[k];
    dvec2 inward = glm::normalize(dvec2(-along.y, along.x));
    if (glm::dot(inward, opposite) < 0) inward = -inward;
    double deepest = -1e9;
    for (int corner = 0; corner < 4; ++corner)
      deepest = std::max(deepest, glm::dot(inward, square + dvec2(corner & 1, corner >> 1) - p[k]));
    least = std::min(least, deepest);
  }
  for (int axis = 0; axis < 2; ++axis) {
    const auto [low, high] = std::minmax({p[0][axis], p[1][axis], p[2][axis]});
    least = std::min({least, high - square[axis], square[axis] + 1 - low});
  }
  return least;
}

TEST_CASE("a triangle, long and thin or not, owns the texels that it reaches into and no others") {
  std::size_t owned = 0;
  for (std::uint32_t i = 0; i < 600; ++i) {
    const std::uint32_t size = i % 2 ? 64 : 37;
    const auto unit = [&](std::uint32_t k) { return float(unit_real(random_bits(1, 2, i, k))); };
    const glm::vec2 a(unit(0), unit(1));
    glm::vec2 b(unit(2), unit(3)), c(unit(4), unit(5));
    // Long and thin; along a row, a column, almost a row; corners at texels' corners
    if (i % 6 == 1) c = glm::mix(glm::mix(a, b, unit(6)), c, 0.01f);
    if (i % 6 == 2) b.y = a.y;
    if (i % 6 == 3) b.x = a.x;
    if (i % 6 == 4) b.y = std::min(a.y + 1e-4f * unit(6), 1.0f);
    if (i % 6 == 5) b = glm::round(b * float(size)) / float(size), c = glm::round(c * float(size)) / float(size);
    Scene scene;
    scene.lightmap_uvs = {a, b, c};
    for (const glm::vec2& corner : scene.lightmap_uvs) scene.positions.emplace_back(corner, 5);
    scene.indices = {0, 1, 2};
    const dvec2 p[] = {dvec2(a) * double(size), dvec2(b) * double(size), dvec2(c) * double(size)};
    const std::vector<TexelOwner> owners = texel_owners(scene, size);
    CAPTURE(i);
    double surface = 0;
    for (const TexelOwner& owner : owners) surface += owner.surface;
    CHECK(surface == doctest::Approx(triangle_area(scene, 0)).epsilon(1e-6));
    for (std::uint32_t cell = 0; cell < owners.size(); ++cell) {
      const double reached = reach(p, dvec2(cell % size, cell / size));
      if (std::fabs(reached) < 1e-9) continue;
      CAPTURE(cell);
      REQUIRE((owners[cell].triangle != kNobody) == (reached > 0));
      owned += reached > 0;
    }
  }
  CHECK(owned > 50000);
}

TEST_CASE("many long thin triangles side by side leave no texel without an owner") {
  constexpr int kCount = 2000;
  constexpr std::uint32_t kSize = 256;
  Scene scene;
  const auto border = [](int k) {
    const double s = 2.0 * k / kCount;
    return s < 1 ? glm::vec2(1, s) : glm::vec2(2 - s, 1);
  };
  for (int k = 0; k < kCount; ++k)
    for (const glm::vec2& uv : {glm::vec2(0), border(k), border(k + 1)}) {
      scene.indices.push_back(std::uint32_t(scene.lightmap_uvs.size()));
      scene.lightmap_uvs.push_back(uv);
      scene.positions.emplace_back(uv * 3.0f, 0);
    }
  for (const TexelOwner& owner : texel_owners(scene, kSize)) {
    REQUIRE(owner.triangle != kNobody);
    CHECK(owner.area > 0);
    CHECK(owner.surface == doctest::Approx(9.0 / (kSize * kSize)).epsilon(1e-4));
  }
}

}  // namespace
}  // namespace twinshade
