// Light: what a technique needs to shade a scene under an environment, as a bundle.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
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
  bool per_vertex = false;            // instead of lightmaps, where the scene has room for them
  std::uint32_t rays = 256;           // per texel or vertex, 1 to 65536
  glm::ivec3 volume{16, 8, 16};       // probes along x, y and z: 1 to 256 each, y times z at most 16384
  std::uint32_t probe_rays = 512;     // per probe, 1 to 65536
  std::uint64_t seed = 1;
  bool bounce = true;  // one gathered bounce
  bool use_cache = true;
  bool show_progress = true;  // on stderr, where it is a terminal
};

// Radiance arriving at each cell, as real SH per channel. Lightmap texels and vertices: l <= 4 in the tangent frame,
// light of the tangent hemisphere (below it there is none). Probes of a volume: l <= 5 in world space, from everywhere.
struct LightBake {
  CoefficientStorage storage = CoefficientStorage::lightmap;
  // Cells: texels; vertices, height 1; or probes, (x, y, z) at cell x, z * volume.y + y.
  std::uint32_t width = 0, height = 0;
  int radiance_count = 25;  // coefficients a channel
  std::vector<float> sh;    // coefficient i of channel c of cell x, y: [((y * width + x) * radiance_count + i) * 3 + c]
  // Irradiance of the flat surface, RGB a cell, gathered without SH in between. Empty for volumes and procedural light.
  std::vector<float> irradiance;
  glm::ivec3 volume{0};                         // probes along each axis
  glm::vec3 volume_origin{0}, volume_scale{0};  // of probe (0, 0, 0); probes per unit of length, 0 along an axis of one
  std::string hash;                             // SHA-256 of the content
  std::vector<std::pair<std::string, std::string>> notes;  // scene, environment and options, for bundles
  double rays_per_second = 0;                              // 0 when it came from the cache
};

// Cached by content under cache_folder(). Light is baked per vertex where the scene has no lightmap UVs. Scenes with
// procedural coefficients get smooth functions of the vertex instead. UserError where an option is out of range.
LightBake bake_light(const Scene& scene, const Environment& environment, const BakeOptions& options);

// An irradiance volume: a regular grid of probes over the scene's bounding box, each in the middle of its share of the
// box. Probes inside of geometry take their light from those around them. Cached, procedural and refused as bake_light.
// Greger, Shirley, Hubbard and Greenberg, The Irradiance Volume, IEEE CG&A 1998.
LightBake bake_volume(const Scene& scene, const Environment& environment, const BakeOptions& options);

struct FrameOptions {
  std::uint32_t width = 1280, height = 800;
  Camera camera;  // usually scene.camera
  bool albedo = true;
  bool normal_map = true;
};

// A technique and where its shader reads coefficients.
struct LitTechnique {
  const TechniqueInfo* technique;
  CoefficientStorage storage;
};

// Everything to draw `wanted`: they share attributes, each basis has its own coefficient texture or attributes in each
// storage that it is read from. lights: at most one of each storage, those that are needed; in the order lightmap,
// vertex, volume they are noted in the bundle ("coefficients").
Bundle make_bundle(const Scene& scene, std::span<const LightBake> lights, const std::vector<LitTechnique>& wanted,
                   const FrameOptions& options);
// All of them lit by the same.
Bundle make_bundle(const Scene& scene, const LightBake& light, const std::vector<const TechniqueInfo*>& wanted,
                   const FrameOptions& options);

}  // namespace twinshade
