// Where light is gathered: the texels of a lightmap that any triangle touches, or the vertices.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "lighting/ray_scene.h"
#include "lighting/registry.h"
#include "scenes/scene.h"

namespace twinshade {

// A point on a triangle from which rays start.
struct Site {
  glm::vec3 origin;            // lifted off the surface
  glm::vec3 geometric_normal;  // of the triangle's front
  std::uint32_t triangle;
};

struct Receiver {
  std::uint32_t cell;                    // texel y * width + x, or vertex
  std::uint32_t first_site, site_count;  // rays are dealt to the sites: Receivers::site_of
  glm::vec3 tangent, bitangent, normal;  // orthonormal, world space
  glm::vec3 albedo;                      // linear; for light that bounces off here
  float area;                            // of the surface that it stands for, in the world
};

inline constexpr std::uint32_t kNoReceiver = 0xffffffffu;
inline constexpr std::size_t kReceiversAtOnce = 64;  // handed to a thread at a time
inline constexpr int kGutter = 8;                    // texels around charts that are filled

struct Receivers {
  CoefficientStorage storage = CoefficientStorage::lightmap;
  std::uint32_t width = 0, height = 0;  // cells; vertices: vertex count x 1
  std::vector<Receiver> list;           // in order of cell
  std::vector<Site> sites;
  std::vector<std::uint32_t> receiver_of_cell;  // kNoReceiver where no triangle is

  // Where a ray of a receiver starts. By a hash: rays with numbers in step share a
  // part of the azimuth.
  const Site& site_of(const Receiver& receiver, std::uint32_t ray) const {
    return sites[receiver.first_site + (ray * 0x9e3779b1u >> 16) % receiver.site_count];
  }

  // The receiver whose light a point of a triangle shows: the texel there; or one of the three vertices, chosen by
  // `choice` in [0, 1) with the barycentric weights as probabilities.
  std::uint32_t at(const Scene& scene, std::uint32_t triangle, double b1, double b2, double choice) const;
};

// Lightmap: a texel belongs to the lowest triangle that contains its centre, else to the one that covers most of it,
// and gathers at its centre or at the middle of what is covered. A triangle without area in the lightmap still gets a
// texel.
Receivers lightmap_receivers(const Scene& scene, const RayScene& rays, std::uint32_t size);

// Vertices: a vertex gathers from up to eight of its triangles, a little way in from the corner, so that what stands on
// an edge does not see both sides of it.
Receivers vertex_receivers(const Scene& scene, const RayScene& rays);

// Tangent space of a point whose interpolated vectors are not unit, not orthogonal or useless. Columns: tangent,
// bitangent, normal. fallback: unit normal where `normal` is no direction.
glm::dmat3 tangent_frame(glm::dvec3 normal, glm::dvec3 tangent, double handedness, const glm::dvec3& fallback);

}  // namespace twinshade
