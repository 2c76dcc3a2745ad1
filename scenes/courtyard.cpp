// A courtyard with an arcade on four sides, a gallery behind it, an upper wall with blind windows, statues and a
// fountain.
#include <array>
#include <cmath>

#include "base/portable_math.h"
#include "scenes/builtin_scenes.h"
#include "scenes/statues.h"
#include "scenes/surface_patterns.h"
#include "scenes/surfaces.h"
#include "scenes/walls.h"

namespace twinshade {
namespace {

using glm::dvec2;
using glm::dvec3;

// Metres. The lines through the columns' centres form a rectangle about the origin.
constexpr double kBay = 2.4;
constexpr int kBaysX = 6, kBaysZ = 5;
constexpr double kHalfX = kBay * kBaysX / 2, kHalfZ = kBay * kBaysZ / 2;
constexpr double kHalfWall = 0.25;  // of the arcade's thickness
constexpr double kFloor = 0.15, kSpring = 2.80, kRadius = 0.92;
constexpr double kBand = 4.30;  // string course
constexpr double kCornice = 7.55, kTop = 8.30;
constexpr double kGallery = 2.50;  // from the columns' line to the outer wall
constexpr double kCeiling = 4.25;
constexpr double kEdge = 0.50;      // from the columns' line to the platform's edge
constexpr double kOverlap = 0.002;  // parts that meet at an angle run into each other

const dvec3 kUp(0, 1, 0);

struct Materials {
  Finish cobbles, bricks, plaster, ashlar, fluted, marble;
};

// One side of the rectangle, seen from inside: along runs from left to right.
struct Side {
  dvec3 inward, along;
  double half_length, distance;  // of the columns' line
  int bays;
  // A point at `s` along, `depth` outwards of the columns' line.
  dvec3 at(double s, double height, double depth) const {
    return along * s - inward * (distance + depth) + kUp * height;
  }
};

std::array<Side, 4> sides() {
  const auto side = [](const dvec3& inward, bool long_side) {
    return Side{inward, glm::cross(kUp, inward), long_side ? kHalfX : kHalfZ, long_side ? kHalfZ : kHalfX,
                long_side ? kBaysX : kBaysZ};
  };
  return {side({0, 0, 1}, true), side({-1, 0, 0}, false), side({0, 0, -1}, true), side({1, 0, 0}, false)};
}

void add_arcade(PatchMesh& mesh, const Materials& materials, const Side& side) {
  const WallCells cells{2, 2, 1, 1, 4};
  // Front and back of the wall above the arches; each chart is the whole side.
  const double front_half = side.half_length - kHalfWall, back_half = side.half_length + kHalfWall;
  const Plane front = make_plane(mesh, side.at(0, 0, -kHalfWall), side.along, kUp, dvec2(-front_half, kSpring),
                                 dvec2(front_half, kBand + 0.1));
  const Plane back = make_plane(mesh, side.at(0, 0, kHalfWall), -side.along, kUp, dvec2(-back_half, kSpring),
                                dvec2(back_half, kBand + 0.1), 0.7);
  for (int i = 0; i < side.bays; ++i) {
    const double centre = -side.half_length + kBay * (i + 0.5);
    const double left = centre - kBay / 2, right = centre + kBay / 2;
    const bool first = i == 0, last = i + 1 == side.bays;
    const double trim = kHalfWall - kOverlap;
    add_wall_bay(mesh, front, materials.ashlar, {left + (first ? trim : 0), kSpring},
                 {right - (last ? trim : 0), kBand + 0.1}, {centre, kRadius, kSpring, kSpring}, cells);
    add_wall_bay(mesh, back, materials.plaster, {-right - (last ? trim : 0), kSpring},
                 {-left + (first ? trim : 0), kBand + 0.1}, {-centre, kRadius, kSpring, kSpring}, cells);
    // Soffit of the arch and the raised ring around it.
    add_arch_sweep(
        mesh, side.at(centre, kSpring, -kHalfWall), side.along, kUp,
        {line({kRadius, -2 * kHalfWall}, {kRadius, 0.04}, 2), line({kRadius, 0.04}, {kRadius + 0.10, 0.04}),
         line({kRadius + 0.10, 0.04}, {kRadius + 0.10, 0.07}), line({kRadius + 0.10, 0.07}, {kRadius + 0.21, 0.07}),
         line({kRadius + 0.21, 0.07}, {kRadius + 0.21, -kOverlap})},
        materials.marble, cells.arch);
  }
}

void add_column(PatchMesh& mesh, const Materials& materials, const dvec3& foot) {
  constexpr double kPlinth = 0.12, kBase = 0.31, kShaftTop = 2.38, kCapital = 2.68, kShaft = 0.215, kNeck = 0.185;
  const double floor = foot.y, around = 16;
  add_box(mesh, foot + kUp * (kPlinth / 2), {0.31, kPlinth / 2 + kOverlap, 0.31}, "xXYzZ", materials.marble);
  // Attic base: two rings with a hollow between.
  add_revolved(
      mesh, foot,
      {arc({0.25, kPlinth + 0.045}, {0.050, 0.045}, -90, 90, 3),
       arc({0.25, kPlinth + 0.120}, {0.030, 0.030}, 270, 90, 2), line({0.25, kPlinth + 0.15}, {0.235, kPlinth + 0.15}),
       arc({0.235, kPlinth + 0.165}, {0.025, 0.015}, -90, 90, 2), line({0.235, kPlinth + 0.18}, {kShaft, kBase})},
      materials.marble, around, 2);
  // Shaft, slightly swollen (entasis): width over height is a part of a parabola.
  const auto shaft = [=](double t) {
    return dvec2(kShaft * (1 - t) + kNeck * t + 0.012 * t * (1 - t) * 4, kBase + (kShaftTop - floor - kBase) * t);
  };
  add_revolved(mesh, foot, {{shaft, kShaftTop - floor - kBase, 5}}, materials.fluted, around, 5);
  const double neck = kShaftTop - floor;
  add_revolved(mesh, foot,
               {arc({kNeck, neck + 0.02}, {0.030, 0.020}, -90, 90, 2), line({kNeck, neck + 0.04}, {kNeck, neck + 0.11}),
                arc({kNeck + 0.09, neck + 0.11}, {0.09, 0.13}, 180, 90, 4),
                arc({kNeck + 0.09, neck + 0.27}, {0.03, 0.03}, -90, 90, 2)},
               materials.marble, around, 2);
  add_box(mesh, {foot.x, 0.5 * (kCapital + kSpring), foot.z}, {0.32, 0.5 * (kSpring - kCapital) + kOverlap, 0.32},
          "xXyYzZ", materials.marble);
}

void add_upper_wall(PatchMesh& mesh, const Materials& materials, const Side& side) {
  const WallCells cells{2, 2, 3, 1, 3};
  const double half = side.half_length - kHalfWall + kOverlap;
  const Plane wall = make_plane(mesh, side.at(0, 0, -kHalfWall), side.along, kUp, dvec2(-half, kBand + 0.1),
                                dvec2(half, kCornice + 0.1));
  Finish panel = materials.fluted;
  panel.cell = 1;
  for (int i = 0; i < side.bays; ++i) {
    const double centre = -side.half_length + kBay * (i + 0.5);
    const double left = std::max(centre - kBay / 2, -half), right = std::min(centre + kBay / 2, half);
    const Opening window{centre, 0.46, 5.15, 6.35};
    add_wall_bay(mesh, wall, materials.bricks, {left, kBand + 0.1}, {right, kCornice + 0.1}, window, cells);
    add_niche(mesh, wall, materials.marble, panel, window, 0.30, cells);
    // Raised surround of the arch, and a sill.
    const double r = window.half_width;
    add_arch_sweep(mesh, side.at(centre, window.spring, -kHalfWall), side.along, kUp,
                   {line({r, -kOverlap}, {r, 0.05}), line({r, 0.05}, {r + 0.13, 0.05}),
                    line({r + 0.13, 0.05}, {r + 0.13, -kOverlap})},
                   materials.marble, cells.arch);
    const bool along_x = std::fabs(side.along.x) > 0.5;
    const auto block = [&](double s, double height, double half_s, double half_h, double out, const char* faces) {
      const dvec3 half_size = along_x ? dvec3(half_s, half_h, out) : dvec3(out, half_h, half_s);
      add_box(mesh, side.at(s, height, -kHalfWall), half_size, faces, materials.marble);
    };
    block(centre, window.sill - 0.06, r + 0.20, 0.06, 0.11, "xXyYzZ");
    for (double s : {centre - r - 0.065, centre + r + 0.065})
      block(s, 0.5 * (window.sill + window.spring), 0.065, 0.5 * (window.spring - window.sill), 0.05, "xXzZ");
  }
}

void add_mouldings(PatchMesh& mesh, const Materials& materials, const Side& side) {
  const double half = side.half_length - kHalfWall;
  Finish stone = materials.marble;
  stone.cell = 0.8;
  // String course between arcade and upper wall.
  add_extruded(mesh, side.at(-half, kBand, -kHalfWall), side.at(half, kBand, -kHalfWall), 1,
               {line({-0.01, 0}, {0.05, 0}), line({0.05, 0}, {0.05, 0.07}), arc({0.13, 0.07}, {0.08, 0.07}, 180, 90, 2),
                line({0.13, 0.14}, {0.13, 0.21}), line({0.13, 0.21}, {-0.01, 0.25})},
               stone);
  // Cornice: brackets' band, hollow, corona, rounded crown.
  add_extruded(
      mesh, side.at(-half, kCornice, -kHalfWall), side.at(half, kCornice, -kHalfWall), 1,
      {line({-0.01, 0}, {0.06, 0}), line({0.06, 0}, {0.06, 0.12}), arc({0.22, 0.12}, {0.16, 0.16}, 180, 90, 3),
       line({0.22, 0.28}, {0.36, 0.28}), line({0.36, 0.28}, {0.36, 0.45}), arc({0.36, 0.55}, {0.10, 0.10}, -90, 0, 2),
       arc({0.36, 0.55}, {0.10, 0.10}, 0, 90, 2), line({0.36, 0.65}, {-0.40, kTop - kCornice})},
      stone);
  // Edge of the platform: a step with a rounded nose.
  const double reach = side.half_length - kEdge;
  add_extruded(mesh, side.at(-reach, 0, -kEdge), side.at(reach, 0, -kEdge), 1,
               {line({-0.03, -kOverlap}, {-0.03, 0.09}), line({-0.03, 0.09}, {0, 0.10}),
                arc({0, 0.125}, {0.025, 0.025}, -90, 90, 3), line({0, kFloor}, {-0.25, kFloor + kOverlap})},
               stone);
  // Skirting of the gallery's outer wall.
  const double outer = side.half_length + kGallery;
  add_extruded(mesh, side.at(-outer, kFloor, kGallery), side.at(outer, kFloor, kGallery), 1,
               {line({0.05, -kOverlap}, {0.05, 0.34}), arc({0, 0.34}, {0.05, 0.04}, 0, 90, 2)}, stone, 0.7);
}

void add_gallery(PatchMesh& mesh, const Materials& materials, const Side& side, bool long_side) {
  // Outer wall with doors in every second bay.
  const WallCells cells{1, 2, 4, 1, 3};
  const double half = side.half_length + kGallery + kOverlap;
  const Plane wall = make_plane(mesh, side.at(0, 0, kGallery), side.along, kUp, dvec2(-half, kFloor - kOverlap),
                                dvec2(half, kCeiling + kOverlap), 0.8);
  Finish panel = materials.fluted;
  panel.cell = 1;
  for (int i = 0; i < side.bays; ++i) {
    const double centre = -side.half_length + kBay * (i + 0.5);
    const double left = i == 0 ? -half : centre - kBay / 2, right = i + 1 == side.bays ? half : centre + kBay / 2;
    if (i % 2 == 1) {
      const Opening door{centre, 0.55, kFloor - kOverlap, 2.1};
      add_wall_bay(mesh, wall, materials.plaster, {left, kFloor - kOverlap}, {right, kCeiling + kOverlap}, door, cells);
      add_niche(mesh, wall, materials.marble, panel, door, 0.35, cells);
    } else {
      Finish plain = materials.plaster;
      plain.cell = 0.6;
      add_plane_rectangle(mesh, wall, plain, {left, kFloor - kOverlap}, {right, kCeiling + kOverlap});
    }
  }
  // Floor and ceiling: the long sides own the corners.
  const double run = long_side ? half : side.half_length - kEdge;
  const double depth = kGallery + kEdge, start = -run, from = -kEdge;
  const double ceiling_run = long_side ? half : side.half_length + kHalfWall + kOverlap,
               ceiling_depth = kGallery - kHalfWall + kOverlap;
  // v of the floor runs outwards; of the ceiling inwards.
  add_rectangle(mesh, side.at(start, kFloor, from), side.along, -side.inward, 2 * run, depth + kOverlap,
                materials.ashlar, 0.9);
  add_rectangle(mesh, side.at(-ceiling_run, kCeiling, kGallery + kOverlap), side.along, side.inward, 2 * ceiling_run,
                ceiling_depth + kOverlap, materials.plaster, 0.6);
}

void add_fountain(PatchMesh& mesh, const Materials& materials) {
  const dvec3 centre(0);
  Finish stone = materials.marble;
  // A step, the basin's wall with a rounded rim, its inside down to the bottom.
  add_revolved(mesh, centre,
               {line({2.15, -kOverlap}, {2.15, 0.14}), arc({2.12, 0.14}, {0.03, 0.03}, 0, 90, 1),
                line({2.12, 0.17}, {1.80, 0.17}, 2), arc({1.80, 0.22}, {0.05, 0.05}, -90, 0, 2),
                line({1.85, 0.22}, {1.72, 0.30}), line({1.72, 0.30}, {1.72, 0.52}, 2),
                arc({1.72, 0.60}, {0.09, 0.08}, -90, 90, 4), line({1.72, 0.68}, {1.56, 0.68}),
                arc({1.56, 0.62}, {0.05, 0.06}, 90, 180, 2), line({1.51, 0.62}, {1.48, 0.34}),
                line({1.48, 0.34}, {0.45, 0.30}, 3)},
               stone, 40, 6, 1.1);
  // The foot in the middle, and a shallow bowl on it.
  add_revolved(mesh, centre,
               {line({0.46, 0.29}, {0.46, 0.42}), arc({0.42, 0.42}, {0.04, 0.04}, 0, 90, 1),
                arc({0.42, 0.74}, {0.24, 0.28}, 270, 180, 4), line({0.18, 0.74}, {0.17, 0.98}),
                arc({0.20, 1.01}, {0.05, 0.03}, -90, 90, 2), arc({0.20, 1.44}, {0.72, 0.40}, -90, -12, 6),
                arc({0.905, 1.39}, {0.045, 0.045}, -80, 90, 3), line({0.905, 1.435}, {0.85, 1.41}),
                arc({0.10, 1.41}, {0.75, 0.26}, 0, -90, 5), line({0.10, 1.15}, {0.08, 1.15})},
               stone, 28, 3, 1.1);
  add_twist(mesh, {0, 1.13, 0}, 0.95, 0.17, stone);
}

}  // namespace

Scene make_courtyard(std::uint32_t triangles) {
  check_triangle_request(triangles);
  Scene scene;
  scene.name = "courtyard";
  constexpr std::uint32_t kSize = 256;
  Materials materials;
  materials.cobbles = {add_pattern_material(scene, "cobbles", cobbles, kSize, 1.5), 1.5, 0.5};
  materials.bricks = {add_pattern_material(scene, "bricks", bricks, kSize, 1.0), 1.0, 0.6};
  materials.plaster = {add_pattern_material(scene, "plaster", plaster, kSize, 2.0), 2.0, 0.6};
  materials.ashlar = {add_pattern_material(scene, "ashlar", ashlar, kSize, 1.6), 1.6, 0.6};
  materials.fluted = {add_pattern_material(scene, "fluted", fluted, kSize, 0.3), 0.3, 0.6};
  materials.marble = {add_pattern_material(scene, "marble", marble, kSize, 1.0), 1.0, 0.6};

  PatchMesh mesh;
  const double ground_x = kHalfX - kEdge + 0.05, ground_z = kHalfZ - kEdge + 0.05;
  add_rectangle(mesh, {-ground_x, 0, ground_z}, {1, 0, 0}, {0, 0, -1}, 2 * ground_x, 2 * ground_z, materials.cobbles,
                1.2);
  bool long_side = true;
  for (const Side& side : sides()) {
    add_arcade(mesh, materials, side);
    for (int i = 0; i < side.bays; ++i) add_column(mesh, materials, side.at(-side.half_length + kBay * i, kFloor, 0));
    add_upper_wall(mesh, materials, side);
    add_mouldings(mesh, materials, side);
    add_gallery(mesh, materials, side, long_side);
    long_side = !long_side;
  }
  add_fountain(mesh, materials);
  int number = 0;
  for (const dvec2& place : {dvec2(-2.7, -3.8), dvec2(2.7, -3.8), dvec2(2.7, 3.8), dvec2(-2.7, 3.8)}) {
    add_pedestal(mesh, {place.x, 0, place.y}, materials.marble, materials.ashlar);
    add_figure(mesh, {place.x, kPedestalHeight, place.y}, number++, materials.marble);
  }
  mesh.build(scene, triangles);

  scene.camera.eye = {6.3, 1.75, 0.9};
  scene.camera.target = {-2.4, 1.36, -1.70};
  scene.camera.vertical_fov_degrees = 54;
  scene.camera.near_plane = 0.1;
  scene.camera.far_plane = 60;
  return scene;
}

}  // namespace twinshade
