// The two passes of a bake. Direct: rays that leave the scene bring the environment's light, rays that hit a surface
// are remembered. Bounce: those bring what the surface reflects of its own direct irradiance, as a matt surface does.
#pragma once

#include <cstdint>
#include <vector>

#include "lighting/bake.h"
#include "lighting/environment_sampler.h"
#include "lighting/ray_scene.h"
#include "lighting/receivers.h"

namespace twinshade {

struct GatheredLight {
  CoefficientStorage storage = CoefficientStorage::lightmap;
  std::uint32_t width = 0, height = 0;
  std::vector<float> sh;          // as LightBake::sh
  std::vector<float> irradiance;  // as LightBake::irradiance
  std::uint64_t rays = 0;         // traced or decided
};

GatheredLight gather_light(const Scene& scene, const Environment& environment, const BakeOptions& options);

// The first pass alone: what surfaces receive directly, for rays from elsewhere that meet them.
struct SurfaceLight {
  Receivers receivers;
  std::vector<float> irradiance;  // direct irradiance of the flat surface, RGB a cell, without SH in between
  std::uint64_t rays = 0;

  // Radiance towards anywhere above it that the surface at a point of a triangle reflects; choice: as Receivers::at.
  glm::vec3 reflected(const Scene& scene, std::uint32_t triangle, double b1, double b2, double choice) const;
};

// Texels each way of the lightmap that light is reflected from where it is the first pass of something else.
inline constexpr std::uint32_t kSurfaceMap = 128;

SurfaceLight gather_surface_light(const Scene& scene, const RayScene& rays, const EnvironmentSampler& light,
                                  const BakeOptions& options);

}  // namespace twinshade
