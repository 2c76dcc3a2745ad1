// Textures that the shaders of precomputed visibility read: weights and L x H tables, in layers or packed.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "bundle/bundle.h"
#include "lighting/light_tables.h"
#include "lighting/registry.h"

namespace twinshade {

// The widest and highest texture that OpenGL 4.5 and the renderers are sure to take.
inline constexpr std::uint32_t kWidestTexture = 16384;

// Weights 4q to 4q + 3 of each texel of a lightmap. layers: layer q; dx9: the q-th of square lightmaps side by side
// (technique/visibility_lightmap_packed.glsl). weight(cell, i): cell = y * size + x, i < 4 * quads. UserError where the
// packed texture would be wider than kWidestTexture.
Texture weights_texture(const std::string& name, std::uint32_t size, std::size_t quads, TexturePacking packing,
                        const std::function<float(std::size_t cell, std::size_t i)>& weight);
// Quads of weights that such a texture has.
std::uint32_t stored_quads(const Texture& weights);

// layers: RGB of map m, layer l at layer l * maps + m, A is 1; row r is map r; maps are filled up to fives, unless
// there is but one. dx9: bands of layers side by side (technique/light_tables_packed.glsl); mean: row 0 is the mean's,
// whose weight is 1. UserError where the packed texture would be wider or higher than kWidestTexture.
Texture light_table_texture(const std::string& name, const LightTables& tables, const SphereMapInfo& map, int width,
                            bool mean, TexturePacking packing);

}  // namespace twinshade
