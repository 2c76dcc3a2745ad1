// Normals and coefficients that a basis may trip over: where its formulas divide by zero, take roots of rounding
// errors, change branches or overflow.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "experiments/stability/light_fit.h"
#include "lighting/registry.h"

namespace twinshade {

// Each component is a float. `inside`: of the method's domain, a unit vector but for rounding (1e-6) and, for the
// hemisphere, not below the horizon by more than that. Others may come from interpolation or from normal maps.
struct TrickyNormal {
  glm::dvec3 n;
  std::string what;
  bool inside;
};

// Axes, corners and edges of octants, with zeros of both signs; the icosahedron's vertices, edges and faces; the
// horizon and the poles with what is hardly apart from them; each also one float step aside along each axis. Outside:
// the zero vector, below the horizon, other lengths, the
// mildest first. NaN is not among them: the host counts it as zero.
std::vector<TrickyNormal> tricky_normals(Domain domain);

// [i * 3 + channel], floats. `inside`: what a texel of half precision can hold.
struct TrickyCoefficients {
  std::vector<double> values;
  std::string what;
  bool inside;
};

// Of lights (none, constant, of one channel, suns), of what is no light (without a mean, negative), and numbers as they
// come: each coefficient alone, random, denormal, the largest half; outside: beyond that.
std::vector<TrickyCoefficients> tricky_coefficients(const TechniqueInfo& basis, const LightFit& fit,
                                                    std::uint64_t seed);

}  // namespace twinshade
