// The surfaces that built-in scenes are made of, as patches. Right-handed, Y up, metres.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <vector>

#include "scenes/patch_mesh.h"

namespace twinshade {

// Material and grain of what is being built.
struct Finish {
  int material = 0;
  double tile = 1;    // metres that one tile of the material covers
  double cell = 0.5;  // metres, size of a cell at density 1
};

// A plane with its own coordinates (a along u, b along v, metres); the outside is cross(u, v). Its chart covers
// [low, high] of these coordinates.
struct Plane {
  glm::dvec3 origin, u, v;  // u, v: unit, orthogonal
  glm::dvec2 low, high;
  int chart = 0;
};
Plane make_plane(PatchMesh& mesh, const glm::dvec3& origin, const glm::dvec3& u, const glm::dvec3& v,
                 const glm::dvec2& low, const glm::dvec2& high, double texel_weight = 1);
SurfacePoint plane_point(const Plane& plane, const glm::dvec2& ab, double tile);

// Part of a plane: `ab` maps [0, 1]^2 one-to-one to the plane's coordinates.
void add_plane_part(PatchMesh& mesh, const Plane& plane, const Finish& finish, double columns, double rows,
                    std::function<glm::dvec2(double, double)> ab, bool pole_at_start = false);
void add_plane_rectangle(PatchMesh& mesh, const Plane& plane, const Finish& finish, const glm::dvec2& low,
                         const glm::dvec2& high);
// make_plane and the whole of it.
void add_rectangle(PatchMesh& mesh, const glm::dvec3& origin, const glm::dvec3& u, const glm::dvec3& v, double width,
                   double height, const Finish& finish, double texel_weight = 1);

// One smooth piece of a profile in (outwards, up); profiles are corners between such pieces. Going up, the outside is
// on the side of growing x.
struct Piece {
  std::function<glm::dvec2(double t)> at;  // t in [0, 1]
  double length;                           // metres
  double cells;                            // at density 1
};
using Profile = std::vector<Piece>;
Piece line(const glm::dvec2& from, const glm::dvec2& to, double cells = 1);
// Part of a circle or ellipse: centre + radius * (cos a, sin a), a from `from` to `to`, degrees.
Piece arc(const glm::dvec2& centre, const glm::dvec2& radius, double from, double to, double cells = 3);
double length_of(const Profile& profile);

// Revolved about the vertical through `centre`; turns: how often the material repeats around. x of a profile is the
// radius; a radius of 0 may only begin the first or end the last piece.
void add_revolved(PatchMesh& mesh, const glm::dvec3& centre, const Profile& profile, const Finish& finish,
                  double columns, double turns, double texel_weight = 1);

// Pushed along a straight line; `from` and `to` at outwards = 0, up = 0; the outside is cross(to - from, up).
// mitre: how much each end draws in per metre of outwards (1: inner corner of 90 degrees).
void add_extruded(PatchMesh& mesh, const glm::dvec3& from, const glm::dvec3& to, double mitre, const Profile& profile,
                  const Finish& finish, double texel_weight = 1);

// Swept over a half circle from the left springing (-radius, 0) over the top to the right one, about `centre` in the
// plane (along, up). x of a profile is the radius, y the distance from the plane towards cross(along, up). Parts of 45,
// 90 and 45 degrees with `columns`, twice `columns` and `columns` cells, as around an Opening's arch (walls.h).
void add_arch_sweep(PatchMesh& mesh, const glm::dvec3& centre, const glm::dvec3& along, const glm::dvec3& up,
                    const Profile& profile, const Finish& finish, double columns, double texel_weight = 1);

// Axis-aligned in its own frame; faces: any of 'x', 'X' (-u, +u side), 'y', 'Y' (bottom, top), 'z', 'Z'.
void add_box(PatchMesh& mesh, const glm::dvec3& centre, const glm::dvec3& half, const char* faces, const Finish& finish,
             double texel_weight = 1);

// A ball bent by `shape` (unit direction to position) in six square patches. Normals and tangents by central
// differences.
void add_ball(PatchMesh& mesh, const std::function<glm::dvec3(const glm::dvec3& direction)>& shape, double radius,
              const Finish& finish, double cells, double texel_weight = 1);

// Any smooth tube: position(u, v), u around, v along; v = 0 or v = 1 is a single point where said. width, height:
// metres, for the chart.
void add_tube(PatchMesh& mesh, const std::function<glm::dvec3(double u, double v)>& position, double width,
              double height, const Finish& finish, double columns, double rows, const glm::dvec2& repeats,
              bool pole_at_start, bool pole_at_end, double texel_weight = 1);

}  // namespace twinshade
