#include "scenes/surfaces.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/portable_math.h"
#include "scenes/blend.h"

namespace twinshade {
namespace {

using glm::dvec2;
using glm::dvec3;

constexpr double kDegree = portable::kPi / 180;

// Directions of growth by central differences; poles are approached from inside, where both directions exist.
constexpr double kStep = 0x1p-12;

double inside(double t) { return std::clamp(t, 2 * kStep, 1 - 2 * kStep); }

dvec2 slope(const Piece& piece, double t) {
  const double s = inside(t);
  return piece.at(s + kStep) - piece.at(s - kStep);
}

// A profile's pieces share one chart; [start, end] of piece i, as a part of the whole length.
struct Span {
  double start, end;
};
std::vector<Span> spans(const Profile& profile) {
  const double whole = length_of(profile);
  std::vector<Span> result;
  double at = 0;
  for (const Piece& piece : profile) {
    result.push_back({at / whole, (at + piece.length) / whole});
    at += piece.length;
  }
  return result;
}

}  // namespace

Plane make_plane(PatchMesh& mesh, const dvec3& origin, const dvec3& u, const dvec3& v, const dvec2& low,
                 const dvec2& high, double texel_weight) {
  const dvec2 size = high - low;
  return {origin, u, v, low, high, mesh.add_chart(size.x * texel_weight, size.y * texel_weight)};
}

SurfacePoint plane_point(const Plane& plane, const dvec2& ab, double tile) {
  SurfacePoint point;
  point.position = plane.origin + plane.u * ab.x + plane.v * ab.y;
  point.normal = glm::cross(plane.u, plane.v);
  point.u_axis = plane.u;
  point.v_axis = plane.v;
  point.uv = ab / tile;
  point.chart = (ab - plane.low) / (plane.high - plane.low);
  return point;
}

void add_plane_part(PatchMesh& mesh, const Plane& plane, const Finish& finish, double columns, double rows,
                    std::function<dvec2(double, double)> ab, bool pole_at_start) {
  Patch patch;
  patch.material = finish.material;
  patch.chart = plane.chart;
  patch.columns = columns;
  patch.rows = rows;
  patch.pole_at_start = pole_at_start;
  patch.at = [plane, tile = finish.tile, ab = std::move(ab)](double u, double v) {
    return plane_point(plane, ab(u, v), tile);
  };
  mesh.add(std::move(patch));
}

void add_plane_rectangle(PatchMesh& mesh, const Plane& plane, const Finish& finish, const dvec2& low,
                         const dvec2& high) {
  const dvec2 size = high - low;
  add_plane_part(mesh, plane, finish, size.x / finish.cell, size.y / finish.cell,
                 [=](double u, double v) { return dvec2(mix(low.x, high.x, u), mix(low.y, high.y, v)); });
}

void add_rectangle(PatchMesh& mesh, const dvec3& origin, const dvec3& u, const dvec3& v, double width, double height,
                   const Finish& finish, double texel_weight) {
  const dvec2 low(0), high(width, height);
  add_plane_rectangle(mesh, make_plane(mesh, origin, u, v, low, high, texel_weight), finish, low, high);
}

Piece line(const dvec2& from, const dvec2& to, double cells) {
  return {[=](double t) { return dvec2(mix(from.x, to.x, t), mix(from.y, to.y, t)); }, glm::length(to - from), cells};
}

Piece arc(const dvec2& centre, const dvec2& radius, double from, double to, double cells) {
  const auto at = [=](double t) {
    const double angle = mix(from, to, t) * kDegree;
    return centre + radius * dvec2(portable::cos(angle), portable::sin(angle));
  };
  return {at, std::fabs(to - from) * kDegree * 0.5 * (radius.x + radius.y), cells};
}

double length_of(const Profile& profile) {
  double sum = 0;
  for (const Piece& piece : profile) sum += piece.length;
  return sum;
}

void add_revolved(PatchMesh& mesh, const dvec3& centre, const Profile& profile, const Finish& finish, double columns,
                  double turns, double texel_weight) {
  double widest = 0;
  for (const Piece& piece : profile)
    for (int i = 0; i <= 8; ++i) widest = std::max(widest, piece.at(i / 8.0).x);
  const double length = length_of(profile);
  const int chart = mesh.add_chart(2 * portable::kPi * widest * texel_weight, length * texel_weight);
  const std::vector<Span> span = spans(profile);
  for (std::size_t i = 0; i < profile.size(); ++i) {
    Patch patch;
    patch.material = finish.material;
    patch.chart = chart;
    patch.columns = columns;
    patch.rows = profile[i].cells;
    patch.pole_at_start = i == 0 && profile[i].at(0).x < 1e-9;
    patch.pole_at_end = i + 1 == profile.size() && profile[i].at(1).x < 1e-9;
    patch.at = [=, piece = profile[i], part = span[i], tile = finish.tile](double u, double v) {
      const double angle = 2 * portable::kPi * u;
      // Both ends of the seam are one point.
      const double c = u == 1 ? 1 : portable::cos(angle), s = u == 1 ? 0 : portable::sin(angle);
      const dvec2 at = piece.at(v), grow = slope(piece, v);
      SurfacePoint point;
      point.position = centre + dvec3(at.x * c, at.y, -at.x * s);
      point.normal = dvec3(grow.y * c, -grow.x, -grow.y * s);
      point.u_axis = dvec3(-s, 0, -c);
      point.v_axis = dvec3(grow.x * c, grow.y, -grow.x * s);
      const double along = mix(part.start, part.end, v);
      point.uv = dvec2(u * turns, along * length / tile);
      point.chart = dvec2(u, along);
      return point;
    };
    mesh.add(std::move(patch));
  }
}

void add_extruded(PatchMesh& mesh, const dvec3& from, const dvec3& to, double mitre, const Profile& profile,
                  const Finish& finish, double texel_weight) {
  const double run = glm::length(to - from), length = length_of(profile);
  const dvec3 along = (to - from) / run, up(0, 1, 0), out = glm::cross(along, up);
  double widest = 0;  // outwards, negative with negative mitre
  for (const Piece& piece : profile)
    for (int i = 0; i <= 8; ++i) widest = std::max(widest, -mitre * piece.at(i / 8.0).x);
  const double chart_run = run + 2 * widest;
  const int chart = mesh.add_chart(chart_run * texel_weight, length * texel_weight);
  const std::vector<Span> span = spans(profile);
  for (std::size_t i = 0; i < profile.size(); ++i) {
    Patch patch;
    patch.material = finish.material;
    patch.chart = chart;
    patch.columns = run / finish.cell;
    patch.rows = profile[i].cells;
    patch.at = [=, piece = profile[i], part = span[i], tile = finish.tile](double u, double v) {
      const dvec2 at = piece.at(v), grow = slope(piece, v);
      const double s = mix(mitre * at.x, run - mitre * at.x, u);
      SurfacePoint point;
      point.position = from + along * s + out * at.x + up * at.y;
      point.normal = out * grow.y - up * grow.x;
      point.u_axis = along;
      point.v_axis = out * grow.x + up * grow.y;
      const double travelled = mix(part.start, part.end, v);
      point.uv = dvec2(s, travelled * length) / tile;
      point.chart = dvec2((s + widest) / chart_run, travelled);
      return point;
    };
    mesh.add(std::move(patch));
  }
}

void add_arch_sweep(PatchMesh& mesh, const dvec3& centre, const dvec3& along, const dvec3& up, const Profile& profile,
                    const Finish& finish, double columns, double texel_weight) {
  const dvec3 out = glm::cross(along, up);
  double widest = 0;
  for (const Piece& piece : profile)
    for (int i = 0; i <= 8; ++i) widest = std::max(widest, piece.at(i / 8.0).x);
  const double length = length_of(profile), run = portable::kPi * widest;
  const int chart = mesh.add_chart(run * texel_weight, length * texel_weight);
  const std::vector<Span> span = spans(profile);
  constexpr std::array<double, 4> kCorner = {180, 135, 45, 0};
  for (std::size_t i = 0; i < profile.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      Patch patch;
      patch.material = finish.material;
      patch.chart = chart;
      patch.columns = k == 1 ? 2 * columns : columns;
      patch.rows = profile[i].cells;
      patch.at = [=, piece = profile[i], part = span[i], tile = finish.tile](double u, double v) {
        const double degrees = mix(kCorner[k], kCorner[k + 1], u);
        const double c = portable::cos(degrees * kDegree), s = portable::sin(degrees * kDegree);
        const dvec3 radial = along * c + up * s, forward = along * s - up * c;
        const dvec2 at = piece.at(v), grow = slope(piece, v);
        SurfacePoint point;
        point.position = centre + radial * at.x + out * at.y;
        point.u_axis = forward;
        point.v_axis = radial * grow.x + out * grow.y;
        point.normal = glm::cross(point.u_axis, point.v_axis);
        const double around = (180 - degrees) / 180, travelled = mix(part.start, part.end, v);
        point.uv = dvec2(around * run, travelled * length) / tile;
        point.chart = dvec2(around, travelled);
        return point;
      };
      mesh.add(std::move(patch));
    }
}

void add_box(PatchMesh& mesh, const dvec3& centre, const dvec3& half, const char* faces, const Finish& finish,
             double texel_weight) {
  struct Face {
    char name;
    dvec3 u, v;
    int axis;  // of the normal
  };
  const dvec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  const std::array<Face, 6> all = {
      {{'X', -z, y, 0}, {'x', z, y, 0}, {'Y', x, -z, 1}, {'y', x, z, 1}, {'Z', x, y, 2}, {'z', -x, y, 2}}};
  for (const char* name = faces; *name; ++name)
    for (const Face& face : all) {
      if (face.name != *name) continue;
      const double width = 2 * std::fabs(glm::dot(face.u, half)), height = 2 * std::fabs(glm::dot(face.v, half));
      const dvec3 normal = glm::cross(face.u, face.v);
      const dvec3 origin = centre + normal * half[face.axis] - face.u * (0.5 * width) - face.v * (0.5 * height);
      add_rectangle(mesh, origin, face.u, face.v, width, height, finish, texel_weight);
    }
}

void add_ball(PatchMesh& mesh, const std::function<dvec3(const dvec3&)>& shape, double radius, const Finish& finish,
              double cells, double texel_weight) {
  const double edge = 0.5 * portable::kPi * radius;
  struct Face {
    dvec3 out, u, v;
  };
  const std::array<Face, 6> faces = {{{{1, 0, 0}, {0, 0, -1}, {0, 1, 0}},
                                      {{-1, 0, 0}, {0, 0, 1}, {0, 1, 0}},
                                      {{0, 1, 0}, {1, 0, 0}, {0, 0, -1}},
                                      {{0, -1, 0}, {1, 0, 0}, {0, 0, 1}},
                                      {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}},
                                      {{0, 0, -1}, {-1, 0, 0}, {0, 1, 0}}}};
  for (const Face& face : faces) {
    // Equal angles, not equal steps on the cube: cells of nearly one size.
    const auto position = [face, shape](double u, double v) {
      const double a = portable::tan((u - 0.5) * 0.5 * portable::kPi),
                   b = portable::tan((v - 0.5) * 0.5 * portable::kPi);
      return shape(glm::normalize(face.out + face.u * a + face.v * b));
    };
    Patch patch;
    patch.material = finish.material;
    patch.chart = mesh.add_chart(edge * texel_weight, edge * texel_weight);
    patch.columns = patch.rows = cells;
    patch.at = [position, edge, tile = finish.tile](double u, double v) {
      SurfacePoint point;
      point.position = position(u, v);
      point.u_axis = position(u + kStep, v) - position(u - kStep, v);
      point.v_axis = position(u, v + kStep) - position(u, v - kStep);
      point.normal = glm::cross(point.u_axis, point.v_axis);
      point.uv = dvec2(u, v) * (edge / tile);
      point.chart = dvec2(u, v);
      return point;
    };
    mesh.add(std::move(patch));
  }
}

void add_tube(PatchMesh& mesh, const std::function<dvec3(double, double)>& position, double width, double height,
              const Finish& finish, double columns, double rows, const dvec2& repeats, bool pole_at_start,
              bool pole_at_end, double texel_weight) {
  Patch patch;
  patch.material = finish.material;
  patch.chart = mesh.add_chart(width * texel_weight, height * texel_weight);
  patch.columns = columns;
  patch.rows = rows;
  patch.pole_at_start = pole_at_start;
  patch.pole_at_end = pole_at_end;
  patch.at = [=](double u, double v) {
    const double around = u == 1 ? 0 : u, along = inside(v);
    SurfacePoint point;
    point.position = position(around, v);
    point.u_axis = position(around + kStep, along) - position(around - kStep, along);
    point.v_axis = position(around, along + kStep) - position(around, along - kStep);
    point.normal = glm::cross(point.u_axis, point.v_axis);
    point.uv = dvec2(u, v) * repeats;
    point.chart = dvec2(u, v);
    return point;
  };
  mesh.add(std::move(patch));
}

}  // namespace twinshade
