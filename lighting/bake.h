// Light: what a technique needs to shade a scene under an environment, as a bundle.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bundle/bundle.h"
#include "lighting/registry.h"
#include "scenes/environment.h"
#include "scenes/scene.h"

namespace twinshade {

struct BakeOptions {
  std::uint32_t lightmap_size = 512;  // texels each way
  std::uint32_t rays = 256;           // per texel or vertex
  std::uint64_t seed = 1;
  bool bounce = true;                 // one gathered bounce
  bool use_cache = true;
};

// Radiance arriving at each lightmap texel (or vertex), in its tangent frame, as real SH l <= 4 per channel.
struct LightBake {
  CoefficientStorage storage = CoefficientStorage::lightmap;
  std::uint32_t width = 0, height = 0;   // texels; vertex storage: width = vertex count, height = 1
  std::vector<float> sh;                 // 25 * 3 planes of width * height: plane (i * 3 + channel)
  std::string hash;                      // SHA-256 of the content
  double rays_per_second = 0;            // 0 when it came from the cache
};

// Cached by content under cache_folder(). Progress on stderr where it is a terminal.
LightBake bake_light(const Scene& scene, const Environment& environment, const BakeOptions& options);

// SH irradiance (after A_l) or any other linear basis' coefficients from the radiance: count planes RGB per texel.
// Row-major matrix [basis count][25]: coefficient_b = sum_j M[b][j] * radiance_j. A_l is folded in. From the basis' GLSL in
// double, by least squares over the basis' domain.
std::vector<double> operator_from_radiance(const TechniqueInfo& technique);

struct FrameOptions {
  std::uint32_t width = 1280, height = 800;
  Camera camera;          // usually scene.camera
  bool albedo = true;
  bool normal_map = true;
};

// Everything to draw `techniques` (all share attributes, each has its own coefficient texture or attributes).
Bundle make_bundle(const Scene& scene, const LightBake& light, const std::vector<const TechniqueInfo*>& techniques,
                   const FrameOptions& options);

}  // namespace twinshade
