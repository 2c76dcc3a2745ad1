// Directions that experiments look in: evenly over the sphere, and about one of them.
#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>

namespace twinshade {

// Number i of `count` directions, evenly over the sphere: Fibonacci lattice (Gonzalez, Measurement of areas on a sphere
// using Fibonacci and latitude-longitude lattices, 2010).
glm::dvec3 lattice_direction(std::size_t i, std::size_t count);

// Two directions perpendicular to a unit vector and to each other (Duff et al., Building an Orthonormal Basis,
// Revisited, JCGT 2017).
std::array<glm::dvec3, 2> tangents(const glm::dvec3& n);

// Eight directions at an angle of about `step` radians, small, from the unit vector n.
std::array<glm::dvec3, 8> directions_around(const glm::dvec3& n, double step);

// Each component the nearest float.
glm::dvec3 to_float(const glm::dvec3& v);

}  // namespace twinshade
