#include "lighting/receivers.h"

#include <doctest/doctest.h>

#include <cmath>

#include "lighting/fill.h"
#include "lighting/random.h"
#include "lighting/texel_coverage.h"
#include "tests/lighting/small_scenes.h"

namespace twinshade {
namespace {

TEST_CASE("every texel that a point of a triangle lies in has an owner, and its place is on that owner") {
  Scene scene = scene_with_albedo(0.5f);
  add_rectangle(scene, {0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {0.113f, 0.207f}, 0.331f);
  add_rectangle(scene, {0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {0.61f, 0.5f}, 0.004f);  // smaller than a texel
  scene.lightmap_uvs[1] += glm::vec2(0.07f, -0.03f);                             // no right angles
  constexpr std::uint32_t size = 37;
  const std::vector<TexelOwner> owners = texel_owners(scene, size);
  for (int i = 0; i < 20000; ++i) {
    const std::uint32_t t = std::uint32_t(i) % std::uint32_t(scene.triangle_count());
    double b1 = unit_real(random_bits(1, 2, i, 0)), b2 = unit_real(random_bits(1, 2, i, 1));
    if (b1 + b2 > 1) b1 = 1 - b1, b2 = 1 - b2;
    const auto uv = [&](int k) { return glm::dvec2(scene.lightmap_uvs[scene.indices[3 * t + k]]); };
    const glm::dvec2 at = (uv(0) * (1 - b1 - b2) + uv(1) * b1 + uv(2) * b2) * double(size);
    const TexelOwner& owner = owners[std::uint32_t(at.y) * size + std::uint32_t(at.x)];
    CAPTURE(i);
    CHECK(owner.triangle != kNoTriangle);
  }
  std::size_t owned = 0, centred = 0;
  for (std::uint32_t cell = 0; cell < owners.size(); ++cell) {
    const TexelOwner& owner = owners[cell];
    if (owner.triangle == kNoTriangle) continue;
    ++owned;
    CHECK(owner.b1 >= 0);
    CHECK(owner.b2 >= 0);
    CHECK(owner.b1 + owner.b2 <= 1 + 1e-12);
    const auto uv = [&](int k) { return glm::dvec2(scene.lightmap_uvs[scene.indices[3 * owner.triangle + k]]); };
    const glm::dvec2 at = (uv(0) * (1 - owner.b1 - owner.b2) + uv(1) * owner.b1 + uv(2) * owner.b2) * double(size);
    const glm::dvec2 texel(cell % size, cell / size);
    CHECK(std::abs(at.x - texel.x - 0.5) < 0.5 + 1e-9);
    CHECK(std::abs(at.y - texel.y - 0.5) < 0.5 + 1e-9);
    if (owner.area == 2) {
      ++centred;
      CHECK(glm::length(at - texel - 0.5) < 1e-9);
    }
  }
  CHECK(centred > 100);
  CHECK(owned > centred + 10);
}

TEST_CASE("a lightmap receiver stands on its texel, just above the surface, in an orthonormal frame") {
  const Scene scene = floor_scene(2);
  const RayScene rays(scene);
  const Receivers receivers = lightmap_receivers(scene, rays, 8);
  REQUIRE(receivers.list.size() == 64);
  for (const Receiver& receiver : receivers.list) {
    REQUIRE(receiver.site_count == 1);
    const glm::vec3 origin = receivers.sites[receiver.first_site].origin;
    CHECK(origin.x == doctest::Approx(-2 + 4 * (receiver.cell % 8 + 0.5) / 8));
    CHECK(origin.z == doctest::Approx(2 - 4 * (receiver.cell / 8 + 0.5) / 8));
    CHECK(origin.y > 0);
    CHECK(origin.y < 1e-3);
    CHECK(receiver.normal == glm::vec3(0, 1, 0));
    CHECK(receiver.tangent == glm::vec3(1, 0, 0));
    CHECK(receiver.bitangent == glm::vec3(0, 0, -1));
    CHECK(receiver.albedo == glm::vec3(0.5f));
  }
}

TEST_CASE("degenerate lightmap triangles, bad coordinates and useless frames give receivers that are finite") {
  Scene scene = floor_scene();
  scene.lightmap_uvs[3] = scene.lightmap_uvs[2];  // second triangle: no area in the lightmap
  scene.normals[1] = glm::vec3(0);
  scene.tangents[1] = glm::vec4(0, 0, 0, 0);
  scene.normals[2] = glm::vec3(NAN);
  const RayScene rays(scene);
  const Receivers receivers = lightmap_receivers(scene, rays, 16);
  CHECK(receivers.list.size() > 100);
  for (const Receiver& r : receivers.list) {
    const glm::dmat3 frame(r.tangent, r.bitangent, r.normal);
    const glm::dmat3 product = glm::transpose(frame) * frame;
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) CHECK(std::abs(product[i][k] - (i == k)) < 1e-6);
  }
  scene.lightmap_uvs.assign(4, glm::vec2(NAN, INFINITY));
  CHECK(lightmap_receivers(scene, rays, 16).list.empty());
}

TEST_CASE("a vertex gathers from all its triangles; one without triangles is no receiver") {
  Scene scene = floor_scene();
  scene.positions.push_back({5, 5, 5});
  scene.normals.push_back({0, 1, 0});
  scene.tangents.push_back({1, 0, 0, 1});
  scene.uvs.push_back({0, 0});
  scene.lightmap_uvs.clear();
  const RayScene rays(scene);
  const Receivers receivers = vertex_receivers(scene, rays);
  REQUIRE(receivers.list.size() == 4);
  CHECK(receivers.receiver_of_cell[4] == kNoReceiver);
  CHECK(receivers.list[0].site_count == 2);
  CHECK(receivers.list[1].site_count == 1);
  for (const Receiver& r : receivers.list)
    for (std::uint32_t s = 0; s < r.site_count; ++s) {
      const glm::vec3 origin = receivers.sites[r.first_site + s].origin;
      CHECK(std::abs(origin.x) < 1);
      CHECK(std::abs(origin.z) <= 1);
      CHECK(glm::length(origin - scene.positions[r.cell]) < 0.1f);
    }
  CHECK(receivers.at(scene, 0, 0.25, 0.25, 0.1) == 1);
  CHECK(receivers.at(scene, 0, 0.25, 0.25, 0.4) == 2);
  CHECK(receivers.at(scene, 0, 0.25, 0.25, 0.9) == 0);
}

// A row of 64 texels: receivers are [0, 12) and [40, 44).
struct Row {
  Receivers receivers;
  std::vector<std::uint8_t> known = std::vector<std::uint8_t>(64, 0);
  std::vector<float> values = std::vector<float>(64, 0.0f);
  Row() {
    receivers.width = 64, receivers.height = 1;
    receivers.receiver_of_cell.assign(64, kNoReceiver);
    for (std::uint32_t x = 0; x < 64; ++x)
      if (x < 12 || (x >= 40 && x < 44)) {
        receivers.receiver_of_cell[x] = std::uint32_t(receivers.list.size());
        receivers.list.push_back({x, 0, 0, {}, {}, {}, {}, 0});
      }
  }
};

TEST_CASE("filling: receivers from neighbours however far, gutters only so far, what is out of reach keeps its own") {
  Row row;
  row.known[0] = row.known[2] = 1;
  row.values[0] = 1, row.values[2] = 3, row.values[41] = 7;
  FillPlan::lightmap(row.known, row.receivers, 4).apply(row.values, 1);
  CHECK(row.values[0] == 1);
  CHECK(row.values[1] == 2);
  for (int x = 2; x < 16; ++x) CHECK(row.values[x] == 3);
  CHECK(row.values[16] == 0);
  CHECK(row.values[41] == 7);
  CHECK(row.values[43] == 0);
}

}  // namespace
}  // namespace twinshade
