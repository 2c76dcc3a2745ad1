// How far a scene may reach, so that what is computed from its coordinates is finite.
#pragma once

namespace twinshade {

// Metres from the origin, each way. Rays are traced in floats, and Embree takes none whose origin lies beyond 1.8e18.
constexpr double kLargestCoordinate = 1e15;
// Diagonal of the bounds, in metres: frames are drawn in floats, in which squares of smaller lengths vanish.
constexpr double kSmallestExtent = 1e-15;

}  // namespace twinshade
