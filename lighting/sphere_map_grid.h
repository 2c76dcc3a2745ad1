// A sphere map of some width, on the host: where its texels look and which of them a direction reads, by the double
// translation of its GLSL.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "cpu_shaders/runtime/shader_abi.h"
#include "lighting/sphere_maps.h"

namespace twinshade {

// Texels are numbered (layer * width + y) * width + x.
struct SphereMapTaps {
  std::array<std::uint32_t, 4> texel;
  std::array<double, 4> weight;
};

class SphereMapGrid {
 public:
  // width: 1 to 4096, else UserError.
  SphereMapGrid(const SphereMapInfo& map, int width);

  const SphereMapInfo& map() const { return map_; }
  int width() const { return width_; }
  int texels() const { return map_.texels(width_); }

  // Unit directions of all texels. number: float64, or scalar for what the shader itself computes in float.
  std::vector<glm::dvec3> directions(Number number = Number::float64) const;

  // What each of the unit directions reads. number: as for directions.
  std::vector<SphereMapTaps> taps(std::span<const glm::dvec3> directions, Number number = Number::float64) const;

  // Texels less those that look where another one does, as both sides of a fold do.
  int distinct_texels() const;

 private:
  const SphereMapInfo& map_;
  int width_;
  const ShaderModule& directions_;
  const ShaderModule& taps_;
};

}  // namespace twinshade
