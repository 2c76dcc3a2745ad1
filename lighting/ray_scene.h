// Rays against a scene's triangles, the same answer on every machine: Embree only proposes candidates (user geometry
// with padded bounds), a watertight test in double decides.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>

#include "scenes/scene.h"

namespace twinshade {

inline constexpr std::uint32_t kNoTriangle = 0xffffffffu;

// A point is inside something if more than this part of the closest hits around it are back faces.
inline constexpr double kInsideShare = 0.5;

struct RayHit {
  std::uint32_t triangle = kNoTriangle;
  double t = 0;           // in lengths of the direction
  double b1 = 0, b2 = 0;  // barycentric weights of the second and third corner
  bool front = false;     // the side its vertex normals point to
};

// Triangles that have no area or a corner that is not finite are never hit. All functions may be called by many
// threads.
class RayScene {
 public:
  // The instruction set that Embree uses can be chosen by the environment variable TWINSHADE_EMBREE_ISA (sse2, sse4.2,
  // avx, avx2, avx512). UserError where Embree refuses it, or where the scene reaches beyond
  // kLargestCoordinate.
  explicit RayScene(const Scene& scene);
  ~RayScene();
  RayScene(const RayScene&) = delete;
  RayScene& operator=(const RayScene&) = delete;

  // Closest hit with t > 0; among equal t the lowest triangle. `skip` is never hit. direction: not zero.
  RayHit closest(const glm::vec3& origin, const glm::vec3& direction, std::uint32_t skip = kNoTriangle) const;
  // Is anything hit at t > 0?
  bool occluded(const glm::vec3& origin, const glm::vec3& direction, std::uint32_t skip = kNoTriangle) const;

  // Unit normal of a triangle's plane on its front side; zero for triangles that are never hit.
  glm::dvec3 geometric_normal(std::uint32_t triangle) const;
  // How far off a surface, at a place on it, rays from there begin: far above a float's rounding there, far below
  // anything one sees. The same everywhere in most scenes, a part of their diagonal; a few triangles far from the rest
  // do not make it larger.
  double lift(const glm::vec3& place) const;

  struct Impl;

 private:
  std::unique_ptr<Impl> impl_;
};

}  // namespace twinshade
