#include "scenes/walls.h"

#include <array>

#include "base/portable_math.h"
#include "scenes/blend.h"

namespace twinshade {
namespace {

using glm::dvec2;
using glm::dvec3;

// How far parts that meet at an angle run into each other, so that no background shows through the joint.
constexpr double kOverlap = 0.002;

}  // namespace

void add_wall_bay(PatchMesh& mesh, const Plane& plane, const Finish& finish, const dvec2& low, const dvec2& high,
                  const Opening& opening, const WallCells& cells) {
  const double left = opening.centre - opening.half_width, right = opening.centre + opening.half_width;
  const auto rectangle = [&](double x0, double x1, double y0, double y1, double columns, double rows) {
    if (!(x1 > x0 && y1 > y0)) return;
    add_plane_part(mesh, plane, finish, columns, rows,
                   [=](double u, double v) { return dvec2(mix(x0, x1, u), mix(y0, y1, v)); });
  };
  rectangle(low.x, left, low.y, opening.sill, cells.beside, cells.below);
  rectangle(left, right, low.y, opening.sill, cells.across, cells.below);
  rectangle(right, high.x, low.y, opening.sill, cells.beside, cells.below);
  rectangle(low.x, left, opening.sill, opening.spring, cells.beside, cells.jamb);
  rectangle(right, high.x, opening.sill, opening.spring, cells.beside, cells.jamb);

  // Around the arch: from the half circle to the left, top and right edge of the bay.
  struct Part {
    double from, to;   // degrees
    dvec2 start, end;  // on the edge
    double columns;
  };
  const dvec2 foot_left(low.x, opening.spring), top_left(low.x, high.y), top_right = high,
                                                                         foot_right(high.x, opening.spring);
  const std::array<Part, 3> parts = {{{180, 135, foot_left, top_left, cells.arch},
                                      {135, 45, top_left, top_right, 2 * cells.arch},
                                      {45, 0, top_right, foot_right, cells.arch}}};
  for (const Part& part : parts)
    add_plane_part(mesh, plane, finish, part.columns, cells.beside, [=](double u, double v) {
      const double angle = mix(part.from, part.to, u) * (portable::kPi / 180);
      const dvec2 inner = dvec2(opening.centre, opening.spring) +
                          opening.half_width * dvec2(portable::cos(angle), portable::sin(angle));
      return dvec2(mix(inner.x, mix(part.start.x, part.end.x, u), v),
                   mix(inner.y, mix(part.start.y, part.end.y, u), v));
    });
}

void add_niche(PatchMesh& mesh, const Plane& plane, const Finish& reveal, const Finish& panel, const Opening& opening,
               double depth, const WallCells& cells) {
  const dvec3 out = glm::cross(plane.u, plane.v);
  const auto point = [&](double a, double b) { return plane.origin + plane.u * a + plane.v * b; };
  const double left = opening.centre - opening.half_width, right = opening.centre + opening.half_width;
  const double height = opening.spring - opening.sill, width = right - left, deep = depth + kOverlap;

  const auto side = [&](const dvec3& origin, const dvec3& u, const dvec3& v, double run, double columns) {
    const Plane part = make_plane(mesh, origin, u, v, dvec2(0), dvec2(run, deep));
    add_plane_part(mesh, part, reveal, columns, 1, [=](double a, double b) { return dvec2(a * run, b * deep); });
  };
  side(point(right, opening.sill) - out * deep, -plane.u, out, width, cells.across);
  side(point(left, opening.sill) - out * deep, plane.v, out, height, cells.jamb);
  side(point(right, opening.spring) - out * deep, -plane.v, out, height, cells.jamb);
  add_arch_sweep(mesh, point(opening.centre, opening.spring), plane.u, plane.v,
                 {line(dvec2(opening.half_width, -deep), dvec2(opening.half_width, 0))}, reveal, cells.arch);

  const double rim = kOverlap;
  add_rectangle(mesh, point(left - rim, opening.sill - rim) - out * depth, plane.u, plane.v, width + 2 * rim,
                height + opening.half_width + 2 * rim, panel);
}

}  // namespace twinshade
