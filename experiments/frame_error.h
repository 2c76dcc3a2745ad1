// How far a technique's frame is off the light that rays find.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "raster/renderer.h"

namespace twinshade {

// Radiance that pixels of a frame should have, twice: two estimates without common random numbers.
struct Truth {
  std::vector<std::size_t> pixels;
  std::array<std::vector<glm::vec3>, 2> radiance;  // as many as pixels
};

// All relative; NaN where the truth is black.
struct FrameError {
  double rms;    // of the difference, over the truth's own. The truth's noise is taken out: the product of the
                 // differences from both estimates has none in its mean. 0 where that is below zero, within noise.
  double bias;   // mean difference over the truth's mean: brighter is positive
  double worst;  // what 99 of 100 pixels differ by no more, over the truth's root mean square; noise included
  bool finite;   // false: some pixel is NaN or infinite, and all above NaN
};

// Over the three channels of the truth's pixels.
FrameError frame_error(const Frame& frame, const Truth& truth);

// Root mean square of the noise in the mean of both estimates, over the truth's.
double truth_noise(const Truth& truth);

// Of `count` things `wanted` places, in order, one at random in each of as many equal stretches; all of them where
// there are no more.
std::vector<std::size_t> stratified_places(std::size_t count, std::size_t wanted, std::uint64_t seed);

}  // namespace twinshade
