// The two passes of a bake. Direct: rays that leave the scene bring the environment's light, rays that hit a surface
// are remembered. Bounce: those bring what the surface reflects of its own direct irradiance, as a matt surface does.
#pragma once

#include <cstdint>
#include <vector>

#include "lighting/bake.h"

namespace twinshade {

struct GatheredLight {
  CoefficientStorage storage = CoefficientStorage::lightmap;
  std::uint32_t width = 0, height = 0;
  std::vector<float> sh;          // as LightBake::sh
  std::vector<float> irradiance;  // direct irradiance of the flat surface, RGB a cell, without SH in between
  std::uint64_t rays = 0;         // traced or decided
};

GatheredLight gather_light(const Scene& scene, const Environment& environment, const BakeOptions& options);

}  // namespace twinshade
