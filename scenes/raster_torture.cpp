// Triangles that rasterizers get wrong, given in clip space: slivers, shared edges and fans, T-junctions, crossings of
// the near plane, huge ones that leave the screen, zero area, reversed winding, coincident depths, vertices on pixel
// centres. Their light is not baked.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "base/portable_math.h"
#include "scenes/builtin_scenes.h"
#include "scenes/noise.h"
#include "scenes/orthonormal_basis.h"
#include "scenes/patch_mesh.h"
#include "scenes/surface_patterns.h"

namespace twinshade {
namespace {

using glm::dvec2;
using glm::dvec3;
using glm::dvec4;

// Builds indexed triangles of clip-space vertices; all other vertex data comes from the vertex's number.
class Torture {
 public:
  Torture(Scene& scene, std::uint32_t seed) : scene_(scene), random_(seed) {}

  Random& random() { return random_; }

  // Normalised device coordinates x, y, z times w.
  std::uint32_t vertex(double x, double y, double z, double w = 1) { return clip_vertex({x * w, y * w, z * w, w}); }

  std::uint32_t clip_vertex(const dvec4& clip) {
    const auto id = std::uint32_t(scene_.clip_positions.size());
    scene_.clip_positions.emplace_back(clip);
    const double scale = std::max(1.0, std::fabs(clip.w));
    const dvec3 place = glm::clamp(dvec3(clip) / scale, dvec3(-8), dvec3(8));
    scene_.positions.emplace_back(place);
    Random own(id * 2654435761u + 5);
    const dvec3 normal = glm::normalize(dvec3{own.between(-1, 1), own.between(-1, 1), own.between(0.2, 1)});
    const double angle = own.between(0, 2 * portable::kPi);
    const bool mirrored = own.bits() & 1;
    const dvec3 tangent = orthonormal_tangent(normal), bitangent = glm::cross(normal, tangent);
    const dvec3 turned = tangent * portable::cos(angle) + bitangent * portable::sin(angle);
    scene_.normals.emplace_back(normal);
    scene_.tangents.push_back(
        tangent_frame(normal, turned, mirrored ? glm::cross(normal, turned) : glm::cross(turned, normal)));
    scene_.uvs.emplace_back(dvec2(place) * 1.5 + dvec2{own.uniform(), own.uniform()} * 0.3);
    return id;
  }

  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    scene_.indices.insert(scene_.indices.end(), {a, b, c});
    scene_.triangle_materials.push_back(0);
  }

  // Numbers drawn together stand in braces, which are evaluated in order; arguments are not.
  dvec2 within(double half) { return {random_.between(-half, half), random_.between(-half, half)}; }
  // A point within the screen, sometimes a little outside.
  dvec3 somewhere() { return {random_.between(-1.1, 1.1), random_.between(-1.1, 1.1), random_.between(-0.98, 0.98)}; }

 private:
  Scene& scene_;
  Random random_;
};

// Far behind everything else: a coarse grid of shared edges, so that most pixels see several layers.
void backdrop(Torture& t, int cells) {
  std::vector<std::uint32_t> grid;
  for (int j = 0; j <= cells; ++j)
    for (int i = 0; i <= cells; ++i) {
      const bool rim = i == 0 || j == 0 || i == cells || j == cells;
      const double shake = rim ? 0 : 0.8 / cells;
      const dvec2 at = dvec2(2.0 * i / cells - 1, 2.0 * j / cells - 1) + t.within(shake);
      const double depth = t.random().between(0.985, 0.999), w = t.random().between(0.5, 8);
      grid.push_back(t.vertex(at.x, at.y, depth, w));
    }
  for (int j = 0; j < cells; ++j)
    for (int i = 0; i < cells; ++i) {
      const std::uint32_t a = grid[std::size_t(j * (cells + 1) + i)], b = grid[std::size_t(j * (cells + 1) + i + 1)];
      const std::uint32_t d = grid[std::size_t((j + 1) * (cells + 1) + i)],
                          c = grid[std::size_t((j + 1) * (cells + 1) + i + 1)];
      t.triangle(a, b, c);
      t.triangle(a, c, d);
    }
}

// From four pixels down to far less than one, each with its own depth and w.
void small_ones(Torture& t, int count) {
  for (int i = 0; i < count; ++i) {
    const double size = 0.012 * portable::exp2(-8 * t.random().uniform());
    const dvec3 at = t.somewhere();
    std::array<std::uint32_t, 3> v;
    for (auto& id : v) {
      const dvec2 corner = dvec2(at) + t.within(size);
      id = t.vertex(corner.x, corner.y, at.z, t.random().between(0.2, 20));
    }
    t.triangle(v[0], v[1], v[2]);
  }
}

// Long and thinner than a subpixel, at every angle; some exactly horizontal or vertical.
void slivers(Torture& t, int count) {
  for (int i = 0; i < count; ++i) {
    const dvec3 at = t.somewhere();
    const double angle = i % 5 == 0 ? 0.5 * portable::kPi * (i / 5 % 4) : t.random().between(0, 2 * portable::kPi);
    const double length = t.random().between(0.05, 1.2), width = portable::exp2(-4 - 18 * t.random().uniform());
    const dvec2 along(portable::cos(angle) * length, portable::sin(angle) * length);
    const dvec2 across(-along.y * width, along.x * width);
    const double other_depth = t.random().between(-0.9, 0.9);
    const std::uint32_t a = t.vertex(at.x, at.y, at.z, t.random().between(0.5, 4));
    const std::uint32_t b = t.vertex(at.x + along.x, at.y + along.y, other_depth, t.random().between(0.5, 4));
    const double s = t.random().uniform();
    const std::uint32_t c =
        t.vertex(at.x + along.x * s + across.x, at.y + along.y * s + across.y, at.z, t.random().between(0.5, 4));
    t.triangle(a, b, c);
  }
}

// Closed fans: every pixel inside belongs to one triangle and no pixel to two or none.
void fans(Torture& t, int count, int spokes) {
  for (int i = 0; i < count; ++i) {
    const dvec3 at = t.somewhere();
    const double radius = t.random().between(0.02, 0.25);
    const std::uint32_t hub = t.vertex(at.x, at.y, at.z, t.random().between(0.5, 3));
    std::vector<std::uint32_t> rim;
    for (int k = 0; k < spokes; ++k) {
      const double angle = 2 * portable::kPi * (k + 0.4 * t.random().uniform()) / spokes;
      const double r = radius * t.random().between(0.6, 1);
      rim.push_back(
          t.vertex(at.x + r * portable::cos(angle), at.y + r * portable::sin(angle), at.z, t.random().between(0.5, 3)));
    }
    for (int k = 0; k < spokes; ++k) t.triangle(hub, rim[std::size_t(k)], rim[std::size_t((k + 1) % spokes)]);
  }
}

// One long edge on one side, many short ones with vertices on it on the other.
void t_junctions(Torture& t, int count, int pieces) {
  for (int i = 0; i < count; ++i) {
    const dvec3 at = t.somewhere();
    const double angle = t.random().between(0, 2 * portable::kPi), length = t.random().between(0.1, 0.6);
    const dvec2 along(portable::cos(angle) * length, portable::sin(angle) * length),
        across(-along.y * 0.3, along.x * 0.3);
    const std::uint32_t a = t.vertex(at.x, at.y, at.z), b = t.vertex(at.x + along.x, at.y + along.y, at.z);
    t.triangle(a, b, t.vertex(at.x + 0.5 * along.x + across.x, at.y + 0.5 * along.y + across.y, at.z));
    const std::uint32_t below = t.vertex(at.x + 0.5 * along.x - across.x, at.y + 0.5 * along.y - across.y, at.z);
    std::uint32_t previous = b;
    for (int k = 1; k <= pieces; ++k) {
      const double s = 1 - double(k) / pieces;
      const std::uint32_t next = k == pieces ? a : t.vertex(at.x + along.x * s, at.y + along.y * s, at.z);
      t.triangle(previous, next, below);
      previous = next;
    }
  }
}

// Seen by a camera among them: vertices before and behind the eye, on the near plane, beyond the far plane.
void near_crossings(Torture& t, int count) {
  constexpr double kNear = 0.1, kFar = 50;
  const double a = (kFar + kNear) / (kFar - kNear), b = 2 * kFar * kNear / (kFar - kNear);
  for (int i = 0; i < count; ++i) {
    std::array<std::uint32_t, 3> v;
    const dvec3 middle{t.random().between(-3, 3), t.random().between(-2, 2), t.random().between(-2, 4)};
    for (std::size_t k = 0; k < 3; ++k) {
      dvec3 at =
          middle + dvec3{t.random().between(-1.5, 1.5), t.random().between(-1.5, 1.5), t.random().between(-3, 3)};
      if (i % 8 == 0 && k == 0) at.z = kNear;  // on the plane up to rounding
      if (i % 8 == 1 && k == 1) at.z = 0;      // in the eye's plane: w = 0
      if (i % 8 == 2 && k == 2) at.z = 80;     // beyond the far plane
      v[k] = t.clip_vertex({at.x * 1.2, at.y * 1.8, a * at.z - b, at.z});
    }
    t.triangle(v[0], v[1], v[2]);
  }
}

// Far beyond the screen on all sides; kept behind the others by their depth.
void huge_ones(Torture& t, int count) {
  for (int i = 0; i < count; ++i) {
    const double size = portable::exp2(t.random().between(2, 22)), turn = t.random().between(0, 2 * portable::kPi);
    const double depth = t.random().between(0.9, 0.984), offset = t.random().between(-1, 1);
    std::array<std::uint32_t, 3> v;
    for (int k = 0; k < 3; ++k) {
      const double angle = turn + k * 2.1;
      v[std::size_t(k)] = t.vertex(offset + size * portable::cos(angle) + (i % 3 == 0 ? size * 0.52 : 0),
                                   offset + size * portable::sin(angle), depth, t.random().between(0.5, 2));
    }
    t.triangle(v[0], v[1], v[2]);
  }
}

// Repeated indices, repeated positions, three points on a line.
void zero_area(Torture& t, int count) {
  for (int i = 0; i < count; ++i) {
    const dvec3 p = t.somewhere(), q = t.somewhere();
    const std::uint32_t a = t.vertex(p.x, p.y, p.z), b = t.vertex(q.x, q.y, q.z);
    switch (i % 4) {
      case 0:
        t.triangle(a, b, a);
        break;
      case 1:
        t.triangle(a, a, a);
        t.triangle(b, a, b);
        break;
      case 2:
        t.triangle(a, b, t.vertex(q.x, q.y, q.z, 3));
        break;
      default:
        t.triangle(a, b, t.vertex(0.5 * (p.x + q.x), 0.5 * (p.y + q.y), 0.5 * (p.z + q.z)));
        break;
    }
  }
}

// The same triangle again, turned around, or coplanar at one depth: the first one drawn keeps the pixel.
void depth_ties(Torture& t, int count) {
  for (int i = 0; i < count; ++i) {
    const dvec3 at = t.somewhere();
    const double depth = std::floor(at.z * 64) / 64;
    std::array<std::uint32_t, 5> v;
    for (auto& id : v) {
      const dvec2 corner = dvec2(at) + t.within(0.12);
      id = t.vertex(corner.x, corner.y, depth);
    }
    t.triangle(v[0], v[1], v[2]);
    t.triangle(v[0], v[1], v[2]);
    t.triangle(v[2], v[1], v[0]);
    t.triangle(v[1], v[3], v[4]);
  }
}

// Vertices where pixel centres and corners of common frame sizes lie: multiples of 1/32 of the screen and of 1/1280.
void on_the_grid(Torture& t, int count) {
  for (int i = 0; i < count; ++i) {
    const double step = i % 2 == 0 ? 1.0 / 32 : 1.0 / 640, depth = t.random().between(-0.8, 0.8);
    const double x = std::floor(t.random().between(-1, 1) / step) * step,
                 y = std::floor(t.random().between(-1, 1) / step) * step;
    const auto corner = [&](double i_steps, double j_steps) {
      return t.vertex(x + i_steps * step, y + j_steps * step, depth);
    };
    const double n = 1 + t.random().below(6), m = 1 + t.random().below(6);
    const std::uint32_t a = corner(0, 0), b = corner(n, 0), c = corner(n, m), d = corner(0, m);
    if (i % 3 == 0) {
      t.triangle(a, c, b);  // reversed
      t.triangle(a, d, c);
    } else {
      t.triangle(a, b, c);
      t.triangle(a, c, d);
    }
  }
}

// Valid triangles whose neighbours share vertices that are not numbers, infinite, or too large for their products.
void invalid_ones(Torture& t, int count) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity(),
               big = 3e38;
  const std::array<dvec4, 14> bad = {{{nan, 0, 0, 1},
                                      {0, nan, 0, 1},
                                      {0, 0, nan, 1},
                                      {0, 0, 0, nan},
                                      {nan, nan, nan, nan},
                                      {inf, 0, 0, 1},
                                      {-inf, 0.5, 0, 1},
                                      {0, inf, 0.2, 1},
                                      {0, -inf, 0, 1},
                                      {0, 0, inf, 1},
                                      {0, 0, 0, inf},
                                      {0, 0, 0, -inf},
                                      {big, -big, 0, 1},
                                      {big, big, big, big}}};
  for (int i = 0; i < count; ++i) {
    const dvec3 at = t.somewhere();
    const std::uint32_t a = t.vertex(at.x, at.y, at.z), b = t.vertex(at.x + 0.1, at.y, at.z),
                        c = t.vertex(at.x, at.y + 0.1, at.z);
    const std::uint32_t wrong = t.clip_vertex(bad[std::size_t(i) % bad.size()]);
    t.triangle(a, b, c);
    t.triangle(a, wrong, b);
    if (i % 3 == 0) t.triangle(wrong, wrong, c);
    if (i % 5 == 0) t.triangle(c, t.clip_vertex(bad[std::size_t(i * 7 + 3) % bad.size()]), wrong);
  }
}

}  // namespace

Scene make_raster_torture(std::uint32_t triangles, bool with_invalid) {
  check_triangle_request(triangles);
  Scene scene;
  scene.name = with_invalid ? "raster_invalid" : "raster_torture";
  scene.procedural_coefficients = true;
  add_pattern_material(scene, "ashlar", ashlar, 128, 1.6);
  scene.camera.eye = {0, 0, 1};
  scene.camera.target = {0, 0, 0};

  Torture t(scene, with_invalid ? 77 : 7);
  for (std::uint32_t round = 0; scene.triangle_count() < std::max(triangles, 1u); ++round) {
    if (round == 0) backdrop(t, 24);
    huge_ones(t, 24);
    near_crossings(t, 160);
    small_ones(t, 1600);
    slivers(t, 700);
    fans(t, 24, 24);
    t_junctions(t, 60, 9);
    zero_area(t, 120);
    depth_ties(t, 80);
    on_the_grid(t, 300);
    if (with_invalid) invalid_ones(t, 280);
  }
  // No NaN where a frame does not need it: only clip positions may be invalid.
  for (glm::vec3& position : scene.positions)
    for (int c = 0; c < 3; ++c)
      if (!std::isfinite(position[c])) position[c] = 0;
  for (glm::vec2& uv : scene.uvs)
    for (int c = 0; c < 2; ++c)
      if (!std::isfinite(uv[c])) uv[c] = 0;
  return scene;
}

}  // namespace twinshade
