// Ground truth for baked light: rays from each shaded point, nothing projected and nothing stored but what surfaces
// receive directly.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "lighting/bake.h"
#include "lighting/ray_scene.h"
#include "scenes/environment.h"
#include "scenes/scene.h"

namespace twinshade {

// A point on a triangle. World space.
struct ShadedPoint {
  glm::vec3 position;
  glm::vec3 normal;  // unit: the one that shades, normal map included
  glm::vec3 albedo;
  std::uint32_t triangle;
};

struct ReferenceOptions {
  std::uint32_t rays = 1024;  // per point, and an eighth of these towards bright pixels; 1 to 65536
  std::uint64_t seed = 1;
  bool show_progress = true;
};

// Radiance that each point reflects: albedo / pi times the integral of environment, visibility and the clamped cosine
// about its normal. Visibility as bake_visibility has it: nothing below the triangle's plane. Each point has random
// numbers of its own, by its place in the list. UserError where the number of rays is out of range.
std::vector<glm::vec3> reference_radiance(const Scene& scene, const Environment& environment,
                                          std::span<const ShadedPoint> points, const ReferenceOptions& options);

// Radiance that a point reflects: of the environment, and of surfaces that the environment lights (one bounce).
struct ReflectedLight {
  glm::vec3 direct{0}, bounced{0};
};

// The same as reference_radiance and what bounces, as two estimates of half the rays each that share no random numbers:
// the product of the errors of both has no noise in its mean. surfaces: how the direct light of surfaces is gathered,
// on lightmaps of at most 128 x 128 texels or at vertices. UserError where the number of rays is out of range.
std::array<std::vector<ReflectedLight>, 2> reference_light(const Scene& scene, const Environment& environment,
                                                           std::span<const ShadedPoint> points,
                                                           const BakeOptions& surfaces,
                                                           const ReferenceOptions& options);

// An environment that is its own projection on real SH l < order (1 to 6): radiance[j * 3 + c], which may be negative
// somewhere. width: pixels, at least 2; half as many rows.
Environment environment_of_radiance(std::span<const double> radiance, int order, std::uint32_t width);

}  // namespace twinshade
