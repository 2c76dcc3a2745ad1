// How much of the surroundings each point of a scene sees, as spherical harmonics: what the precomputed-visibility
// techniques store in place of light. Iwanicki and Sloan, Normal Mapping with Low-Frequency Precomputed Visibility,
// JGT 2012, section 3.1.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "lighting/registry.h"
#include "scenes/scene.h"

namespace twinshade {

// Coefficients stored, l <= 5 (order 6); those of lower orders are their beginning.
inline constexpr int kVisibilityCount = 36;

struct VisibilityOptions {
  std::uint32_t lightmap_size = 512;  // texels each way, 1 to 4096
  bool per_vertex = false;            // instead of lightmaps, where the scene has room for them
  std::uint32_t rays = 1024;          // directions over the whole sphere, per texel or vertex, 1 to 65536
  std::uint64_t seed = 1;
  bool use_cache = true;
  bool show_progress = true;  // on stderr, where it is a terminal
};

// V(w) is 1 where a ray from the surface in direction w (world space) leaves the scene, 0 where it meets a triangle or
// where w does not point above the surface's own plane: w . geometric normal <= 0.
struct VisibilityBake {
  CoefficientStorage storage = CoefficientStorage::lightmap;
  std::uint32_t width = 0, height = 0;  // cells: texels; vertex storage: width = vertex count, height = 1
  std::vector<float> sh;                // kVisibilityCount a cell: the integral of V Y_i, world space
  std::vector<float> ambient;  // a cell: visible part of the geometric hemisphere, weighed by the cosine, 0 to 1
  std::vector<float> normal;   // [cell * 3 + c]: interpolated; zero where no surface is near
  std::vector<float> area;     // a cell: surface that it stands for, square metres; 0 where there is none
  std::string hash;            // SHA-256 of the content
  std::vector<std::pair<std::string, std::string>> notes;  // scene and options, for bundles
  double rays_per_second = 0;    // traced, those below the surface's plane not counted; 0 when it came from the cache
  std::size_t memory_bytes = 0;  // at the height of baking, scene and ray tree not counted; 0 from the cache

  std::size_t cells() const { return std::size_t(width) * height; }
};

// Cached by content under cache_folder(). Baked per vertex where the scene has no lightmap UVs. Texels inside geometry
// take their neighbours' values, and charts are extended by their gutters. UserError where an option is out of range or
// the scene has no place where anything could be seen from (procedural coefficients).
VisibilityBake bake_visibility(const Scene& scene, const VisibilityOptions& options);

}  // namespace twinshade
