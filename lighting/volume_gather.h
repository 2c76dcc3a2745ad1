// What each probe of an irradiance volume sees: the environment, and surfaces that reflect what they receive directly.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "lighting/bake.h"

namespace twinshade {

struct ProbeGrid {
  glm::ivec3 size{1};
  glm::vec3 origin{0}, scale{0};  // as LightBake

  std::size_t count() const { return std::size_t(size.x) * size.y * size.z; }
  // Probe of cell (z * size.y + y) * size.x + x.
  glm::vec3 position(std::size_t cell) const;
};

// Probes in the middle of their shares of the bounding box of all finite positions (those beyond `limit` in any
// coordinate left aside). An axis along which the scene is thinner than a hundredth of the box' diagonal is widened to
// both sides by a twentieth of it, so that not all probes lie in a surface.
ProbeGrid probe_grid(const Scene& scene, const glm::ivec3& size, float limit);

struct GatheredVolume {
  std::vector<float> sh;  // kVolumeRadianceCount * 3 a probe
  std::uint64_t rays = 0;
};

// Stratified directions over the whole sphere, seeded by probe. A probe most of whose rays meet back faces is inside of
// something and takes the mean of its neighbours.
GatheredVolume gather_volume(const Scene& scene, const Environment& environment, const ProbeGrid& grid,
                             const BakeOptions& options);

}  // namespace twinshade
