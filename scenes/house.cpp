// A wooden house in the afternoon: a shingled gable roof with deep eaves, a porch with posts and railings, a picket
// fence. After the scene of Iwanicki and Sloan, Normal Mapping with Low-Frequency Precomputed Visibility, JGT 2012:
// there is hardly a place that is not shadowed by something narrow.
#include <array>
#include <cmath>

#include "scenes/builtin_scenes.h"
#include "scenes/surface_patterns.h"
#include "scenes/surfaces.h"

namespace twinshade {
namespace {

using glm::dvec2;
using glm::dvec3;

// Metres. The house stands about the origin, its ridge along x, its porch towards +z.
constexpr double kHalfX = 3.0, kHalfZ = 2.2, kEaves = 2.7, kRise = 2.0;
constexpr double kOverhang = 0.5, kVerge = 0.4, kRoof = 0.09;  // roof's thickness
constexpr double kDeck = 0.30, kPorch = 2.0;                   // height and depth of the porch
constexpr double kFenceX = 5.6, kFenceFront = 6.4, kFenceBack = -3.4;
constexpr double kOverlap = 0.002;  // parts that meet at an angle run into each other

const dvec3 kX(1, 0, 0), kUp(0, 1, 0), kZ(0, 0, 1);

struct Materials {
  Finish shingles, siding, planks, trim, cobbles, bricks;
};

// A board of any direction: `corner`, u and v span its upper side, whose normal is cross(u, v).
void add_slab(PatchMesh& mesh, const dvec3& corner, const dvec3& u, const dvec3& v, double width, double height,
              double thickness, const Finish& top, const Finish& rest, double texel_weight = 1) {
  const dvec3 out = glm::cross(u, v), below = corner - out * thickness;
  add_rectangle(mesh, corner, u, v, width, height, top, texel_weight);
  add_rectangle(mesh, below + u * width, -u, v, width, height, rest, 0.6 * texel_weight);
  add_rectangle(mesh, below, u, out, width, thickness, rest, texel_weight);
  add_rectangle(mesh, below + u * width + v * height, -u, out, width, thickness, rest, texel_weight);
  add_rectangle(mesh, below + v * height, -v, out, height, thickness, rest, texel_weight);
  add_rectangle(mesh, below + u * width, v, out, height, thickness, rest, texel_weight);
}

void add_walls(PatchMesh& mesh, const Materials& materials) {
  struct Wall {
    dvec3 foot, along;  // left end as seen from outside
    double length;
  };
  const std::array<Wall, 4> walls = {{{{-kHalfX, 0, kHalfZ}, kX, 2 * kHalfX},
                                      {{kHalfX, 0, kHalfZ}, -kZ, 2 * kHalfZ},
                                      {{kHalfX, 0, -kHalfZ}, -kX, 2 * kHalfX},
                                      {{-kHalfX, 0, -kHalfZ}, kZ, 2 * kHalfZ}}};
  for (const Wall& wall : walls)
    add_rectangle(mesh, wall.foot - kUp * kOverlap, wall.along, kUp, wall.length, kEaves + 0.12, materials.siding);
  // Gables: triangles over the short walls.
  for (const double side : {-1.0, 1.0}) {
    const Plane plane =
        make_plane(mesh, {side * kHalfX, kEaves, 0}, -side * kZ, kUp, dvec2(-kHalfZ, 0), dvec2(kHalfZ, kRise), 0.9);
    add_plane_part(
        mesh, plane, materials.siding, 6, 4,
        [](double u, double v) { return dvec2(kHalfZ * v * (2 * u - 1), kRise * (1 - v)); }, true);
  }
  // Corner boards.
  for (const double x : {-kHalfX, kHalfX})
    for (const double z : {-kHalfZ, kHalfZ})
      add_box(mesh, {x, kEaves / 2, z}, {0.09, kEaves / 2, 0.09}, "xXzZ", materials.trim, 0.7);
}

// A frame on a wall with a panel in it; `centre` on the wall's surface.
void add_window(PatchMesh& mesh, const Materials& materials, const dvec3& centre, const dvec3& along, double half_width,
                double half_height, const Finish& panel) {
  const bool along_x = std::fabs(along.x) > 0.5;
  const auto block = [&](double s, double height, double half_s, double half_h, double out) {
    add_box(mesh, centre + along * s + kUp * height, along_x ? dvec3(half_s, half_h, out) : dvec3(out, half_h, half_s),
            "xXyYzZ", materials.trim, 0.6);
  };
  constexpr double kFrame = 0.06;
  const dvec3 outwards = glm::cross(along, kUp);
  add_rectangle(mesh, centre + outwards * 0.01 - along * half_width - kUp * half_height, along, kUp, 2 * half_width,
                2 * half_height, panel);
  for (const double s : {-half_width, half_width}) block(s, 0, kFrame, half_height + kFrame, 0.06);
  for (const double h : {-half_height, half_height}) block(0, h, half_width + kFrame, kFrame, 0.07);
}

void add_roof(PatchMesh& mesh, const Materials& materials) {
  const double slope = std::sqrt(kHalfZ * kHalfZ + kRise * kRise);
  const dvec3 front_up = dvec3(0, kRise, -kHalfZ) / slope, back_up = dvec3(0, kRise, kHalfZ) / slope;
  // The underside touches the walls' upper edge; the upper side ends at the ridge.
  const double length = slope + kOverhang, width = 2 * (kHalfX + kVerge);
  const dvec3 ridge(0, kEaves + kRise + kRoof * slope / kHalfZ, 0);
  add_slab(mesh, ridge - front_up * length - kX * (width / 2), kX, front_up, width, length + kOverlap, kRoof,
           materials.shingles, materials.trim, 1.3);
  add_slab(mesh, ridge - back_up * length + kX * (width / 2), -kX, back_up, width, length + kOverlap, kRoof,
           materials.shingles, materials.trim, 1.0);
  add_box(mesh, ridge + dvec3(0, 0.01, 0), {kHalfX + kVerge, 0.05, 0.09}, "xXYzZ", materials.trim, 0.8);
  add_box(mesh, {-1.6, 4.6, -0.75}, {0.32, 0.9, 0.32}, "xXzZ", materials.bricks);
  add_box(mesh, {-1.6, 5.5, -0.75}, {0.40, 0.08, 0.40}, "xXyYzZ", materials.bricks);
}

void add_porch(PatchMesh& mesh, const Materials& materials) {
  const double front = kHalfZ + kPorch, height = 2.28, post = 0.075;
  add_box(mesh, {0, kDeck / 2, kHalfZ + kPorch / 2}, {kHalfX, kDeck / 2, kPorch / 2 + 0.1}, "xXYZ", materials.planks);
  for (int step = 1; step <= 2; ++step)
    add_box(mesh, {0, kDeck - 0.1 * step - 0.05, front + 0.1 + 0.15 * step}, {0.75, 0.05, 0.16}, "xXYZ",
            materials.planks);
  // Posts, with braces' place taken by a beam.
  const std::array<double, 4> posts = {-kHalfX + 0.12, -0.85, 0.85, kHalfX - 0.12};
  for (const double x : posts) {
    add_box(mesh, {x, (kDeck + height) / 2, front - 0.1}, {post, (height - kDeck) / 2 + kOverlap, post}, "xXzZ",
            materials.trim);
    add_box(mesh, {x, kDeck + 0.06, front - 0.1}, {0.11, 0.06, 0.11}, "xXYzZ", materials.trim, 0.8);
  }
  add_box(mesh, {0, height + 0.06, front - 0.1}, {kHalfX, 0.07, 0.06}, "xXyYzZ", materials.trim);
  // Railings between the outer posts.
  for (const double side : {-1.0, 1.0}) {
    const double from = 0.85 + post, to = kHalfX - 0.12 - post, middle = side * (from + to) / 2;
    for (const double y : {kDeck + 0.16, kDeck + 0.85})
      add_box(mesh, {middle, y, front - 0.1}, {(to - from) / 2 + kOverlap, 0.03, 0.035}, "yYzZ", materials.trim);
    constexpr int kBalusters = 9;
    for (int i = 0; i < kBalusters; ++i) {
      const double x = side * (from + (to - from) * (i + 0.5) / kBalusters);
      add_box(mesh, {x, kDeck + 0.505, front - 0.1}, {0.035, 0.315 + kOverlap, 0.02}, "xXzZ", materials.trim, 1.2);
    }
  }
  // Lean-to roof.
  const dvec3 eave(-kHalfX - 0.25, height + 0.16, front + 0.35), top(-kHalfX - 0.25, kEaves - 0.02, kHalfZ - 0.02);
  const double run = glm::length(top - eave);
  add_slab(mesh, eave, kX, (top - eave) / run, 2 * kHalfX + 0.5, run, 0.07, materials.shingles, materials.trim, 1.2);
}

// Pickets with rails behind them, from `from` to `to` on the ground.
void add_fence(PatchMesh& mesh, const Materials& materials, const dvec3& from, const dvec3& to) {
  const double length = glm::length(to - from);
  const dvec3 along = (to - from) / length, out = glm::cross(along, kUp);
  const bool along_x = std::fabs(along.x) > 0.5;
  const auto block = [&](double s, double y, double depth, double half_s, double half_h, double half_out,
                         const char* faces, double weight) {
    add_box(mesh, from + along * s + kUp * y - out * depth,
            along_x ? dvec3(half_s, half_h, half_out) : dvec3(half_out, half_h, half_s), faces, materials.trim, weight);
  };
  constexpr double kSpacing = 0.24;
  const int pickets = int(length / kSpacing);
  for (int i = 0; i < pickets; ++i) block((i + 0.5) * length / pickets, 0.53, 0, 0.065, 0.47, 0.018, "xXYzZ", 1.0);
  for (const double y : {0.3, 0.8}) block(length / 2, y, 0.05, length / 2, 0.045, 0.03, "xXyYzZ", 0.8);
  for (const double s : {0.0, length}) block(s, 0.55, 0.06, 0.06, 0.55, 0.06, "xXYzZ", 1.0);
}

}  // namespace

Scene make_house(std::uint32_t triangles) {
  check_triangle_request(triangles);
  Scene scene;
  scene.name = "house";
  constexpr std::uint32_t kSize = 256;
  Materials materials;
  materials.shingles = {add_pattern_material(scene, "shingles", shingles, kSize, 1.2), 1.2, 0.3};
  materials.siding = {add_pattern_material(scene, "siding", siding, kSize, 1.2), 1.2, 0.4};
  materials.planks = {add_pattern_material(scene, "planks", planks, kSize, 1.0), 1.0, 0.4};
  materials.trim = {add_pattern_material(scene, "plaster", plaster, kSize, 2.0), 2.0, 0.5};
  materials.cobbles = {add_pattern_material(scene, "cobbles", cobbles, kSize, 1.5), 1.5, 0.4};
  materials.bricks = {add_pattern_material(scene, "bricks", bricks, kSize, 1.0), 1.0, 0.4};

  PatchMesh mesh;
  add_rectangle(mesh, {-7, 0, 8}, kX, -kZ, 14, 13, materials.cobbles, 0.8);
  add_walls(mesh, materials);
  add_roof(mesh, materials);
  add_porch(mesh, materials);
  const auto panel = [&](double x) { return dvec3(x, 1.5, kHalfZ); };
  add_window(mesh, materials, panel(-1.8), kX, 0.55, 0.6, materials.planks);
  add_window(mesh, materials, panel(1.8), kX, 0.55, 0.6, materials.planks);
  add_window(mesh, materials, {0, 1.3, kHalfZ}, kX, 0.45, 1.0, materials.planks);
  for (const double z : {-1.0, 1.0}) add_window(mesh, materials, {kHalfX, 1.5, z}, -kZ, 0.45, 0.6, materials.planks);
  add_window(mesh, materials, {kHalfX, 3.5, 0}, -kZ, 0.35, 0.4, materials.planks);
  add_fence(mesh, materials, {-kFenceX, 0, kFenceFront}, {-0.8, 0, kFenceFront});
  add_fence(mesh, materials, {0.8, 0, kFenceFront}, {kFenceX, 0, kFenceFront});
  add_fence(mesh, materials, {kFenceX, 0, kFenceFront}, {kFenceX, 0, kFenceBack});
  mesh.build(scene, triangles);

  scene.camera.eye = {6.9, 2.35, 9.8};
  scene.camera.target = {0.35, 1.55, 1.2};
  scene.camera.vertical_fov_degrees = 42;
  scene.camera.near_plane = 0.1;
  scene.camera.far_plane = 60;
  return scene;
}

}  // namespace twinshade
