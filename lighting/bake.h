// Light: what a technique needs to shade a scene under an environment, as a bundle.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "bundle/bundle.h"
#include "lighting/registry.h"
#include "scenes/environment.h"
#include "scenes/scene.h"

namespace twinshade {

struct BakeOptions {
  std::uint32_t lightmap_size = 512;  // texels each way, 1 to 4096
  std::uint32_t rays = 256;           // per texel or vertex, 1 to 65536
  std::uint64_t seed = 1;
  bool bounce = true;  // one gathered bounce
  bool use_cache = true;
  bool show_progress = true;  // on stderr, where it is a terminal
};

// Radiance arriving at each lightmap texel (or vertex), in its tangent frame, as real SH l <= 4 per channel. The light
// is that of the tangent hemisphere: below it there is none.
struct LightBake {
  CoefficientStorage storage = CoefficientStorage::lightmap;
  std::uint32_t width = 0, height = 0;  // texels; vertex storage: width = vertex count, height = 1
  std::vector<float> sh;  // 75 a texel: coefficient i of channel c of texel x, y at (y * width + x) * 75 + i * 3 + c
  std::string hash;       // SHA-256 of the content
  std::vector<std::pair<std::string, std::string>> notes;  // scene, environment and options, for bundles
  double rays_per_second = 0;                              // 0 when it came from the cache
};

// Cached by content under cache_folder(). Light is baked per vertex where the scene has no lightmap UVs. Scenes with
// procedural coefficients get smooth functions of the vertex instead. UserError where an option is out of range.
LightBake bake_light(const Scene& scene, const Environment& environment, const BakeOptions& options);

struct FrameOptions {
  std::uint32_t width = 1280, height = 800;
  Camera camera;  // usually scene.camera
  bool albedo = true;
  bool normal_map = true;
};

// Everything to draw `techniques` (all share attributes, each has its own coefficient texture or attributes).
Bundle make_bundle(const Scene& scene, const LightBake& light, const std::vector<const TechniqueInfo*>& techniques,
                   const FrameOptions& options);

}  // namespace twinshade
