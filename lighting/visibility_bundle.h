// What the shaders of precomputed-visibility techniques read, added to a bundle.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bundle/bundle.h"
#include "lighting/bake.h"
#include "lighting/registry.h"
#include "lighting/sphere_maps.h"
#include "lighting/texel_storage.h"
#include "lighting/visibility_bake.h"
#include "lighting/visibility_components.h"

namespace twinshade {

struct VisibilityLighting {
  std::vector<const SphereMapInfo*> maps;        // of the L x H tables: those that shaders will be drawn with
  int map_width = 0;                             // 1 to 4096; 0: each map's usual one
  int map_halvings = 0;                          // how often that is halved (SphereMapInfo::half)
  int order = 6;                                 // of the visibility that components are taken of, 2 to 6
  PcaMetric metric = PcaMetric::surface;         // what its components are chosen for
  std::vector<double> metric_light;              // of PcaMetric::irradiance, as `radiance`; empty: that itself
  TexelStorage storage = TexelStorage::float32;  // of the weights
  TexturePacking packing = TexturePacking::layers;
};

// Of the tables on this map.
int table_width(const SphereMapInfo& map, const VisibilityLighting& options);

// Weights, tables and uniforms of those of `wanted` that store visibility, each from its storage; normals, tangents and
// lightmap coordinates where the bundle lacks them; notes. bakes: one of each storage that is needed; the principal
// components are those of the first. radiance: of the environment, real SH l <= 5 in world space,
// [j * 3 + c]. UserError where a width or an order is out of range, or a texture would be too large.
void add_visibility(Bundle& bundle, const Scene& scene, std::span<const VisibilityBake> bakes,
                    std::span<const double> radiance, std::span<const LitTechnique> wanted,
                    const VisibilityLighting& options);

// How add_visibility packed the textures of a bundle; layers where it has none.
TexturePacking texture_packing(const Bundle& bundle);

}  // namespace twinshade
