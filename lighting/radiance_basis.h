// What baked radiance is projected on: real spherical harmonics, evaluated by the translations of shaders/basis/.
// Lightmaps and vertices: l <= 4 in tangent space (sh5.glsl); volumes: l <= 5 in world space (sh6.glsl).
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "lighting/registry.h"

namespace twinshade {

inline constexpr int kRadianceCount = 25;        // lightmaps, vertices
inline constexpr int kVolumeRadianceCount = 36;  // volumes
inline constexpr int kHighestOrder = 6;          // bands
inline constexpr int kMostRadianceCount = kHighestOrder * kHighestOrder;

// The basis of radiance with so many functions: 4, 9, 16, 25 or 36, l < 2 to l < 6.
const TechniqueInfo& radiance_technique(int count);

// Values of a linear basis' functions at each direction, by the double translation of its GLSL: [direction * count +
// function].
std::vector<double> basis_values(const TechniqueInfo& basis, std::span<const glm::dvec3> directions);

// The same for the functions of radiance: [direction * count + function].
std::vector<double> radiance_basis(std::span<const glm::dvec3> directions, int count = kRadianceCount);

// What the values of radiance_basis depend on, as a hash: its GLSL.
std::string radiance_basis_hash(int count);

// Irradiance from radiance, band by band: A_l of the clamped cosine, for each of the 36 functions.
// Ramamoorthi and Hanrahan, An Efficient Representation for Irradiance Environment Maps, 2001, eq. 8.
std::array<double, kMostRadianceCount> clamped_cosine_factors();

}  // namespace twinshade
