// What baked radiance is projected on: real spherical harmonics l <= 4 in tangent space, evaluated by the translation
// of shaders/basis/sh5.glsl.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "lighting/registry.h"

namespace twinshade {

inline constexpr int kRadianceCount = 25;

// Values of a linear basis' functions at each direction, by the double translation of its GLSL: [direction * count +
// function].
std::vector<double> basis_values(const TechniqueInfo& basis, std::span<const glm::dvec3> directions);

// The same for all 25 functions of radiance: [direction * 25 + function].
std::vector<double> radiance_basis(std::span<const glm::dvec3> directions);

// Irradiance from radiance, band by band: A_l of the clamped cosine, for each of the 25 functions.
// Ramamoorthi and Hanrahan, An Efficient Representation for Irradiance Environment Maps, 2001, eq. 8.
std::array<double, kRadianceCount> clamped_cosine_factors();

}  // namespace twinshade
