#include "lighting/visibility_textures.h"

#include <fmt/format.h>

#include "base/error.h"

namespace twinshade {
namespace {

Texture layered_texture(const std::string& name, std::uint32_t size, std::size_t layers) {
  Texture texture;
  texture.name = name;
  texture.kind = TextureKind::two_d_array;
  texture.width = texture.height = size;
  texture.layers = std::uint32_t(layers);
  texture.texels.resize(layers * size * size * 4);
  return texture;
}

Texture packed_texture(const std::string& name, std::size_t width, std::size_t height, const char* remedy) {
  if (width > kWidestTexture || height > kWidestTexture)
    throw UserError(
        fmt::format("{} packed into one texture would be {} x {} texels, more than {}; {} or use packing layers", name,
                    width, height, kWidestTexture, remedy));
  Texture texture;
  texture.name = name;
  texture.kind = TextureKind::two_d;
  texture.width = std::uint32_t(width), texture.height = std::uint32_t(height);
  texture.texels.resize(width * height * 4);
  return texture;
}

// Writes one channel of a band: layer after layer of `size` x `size` values, side by side.
void put_band(Texture& texture, std::size_t band, std::size_t channel, std::size_t size, std::size_t layers,
              const float* values) {
  for (std::size_t layer = 0; layer < layers; ++layer)
    for (std::size_t y = 0; y < size; ++y)
      for (std::size_t x = 0; x < size; ++x)
        texture.texels[((band * size + y) * texture.width + layer * size + x) * 4 + channel] =
            values[(layer * size + y) * size + x];
}

}  // namespace

Texture weights_texture(const std::string& name, std::uint32_t size, std::size_t quads, TexturePacking packing,
                        const std::function<float(std::size_t cell, std::size_t i)>& weight) {
  const bool packed = packing == TexturePacking::dx9;
  Texture texture = packed ? packed_texture(name, quads * size, size, "make the lightmap smaller")
                           : layered_texture(name, size, quads);
  for (std::size_t quad = 0; quad < quads; ++quad)
    for (std::size_t y = 0; y < size; ++y)
      for (std::size_t x = 0; x < size; ++x) {
        const std::size_t at = packed ? y * texture.width + quad * size + x : (quad * size + y) * size + x;
        for (std::size_t c = 0; c < 4; ++c) texture.texels[at * 4 + c] = weight(y * size + x, quad * 4 + c);
      }
  return texture;
}

std::uint32_t stored_quads(const Texture& weights) {
  return weights.kind == TextureKind::two_d ? weights.width / weights.height : weights.layers;
}

Texture light_table_texture(const std::string& name, const LightTables& tables, const SphereMapInfo& map, int width,
                            bool mean, TexturePacking packing) {
  TWINSHADE_CHECK_EQ(tables.texels, std::size_t(map.texels(width)));
  const std::size_t size = std::size_t(width), layers = std::size_t(map.layers);
  const auto values = [&](std::size_t row, std::size_t c) {
    return tables.values.data() + (row * 3 + c) * tables.texels;
  };
  if (packing == TexturePacking::layers) {
    // The last five maps are filled up with nothing, unless there is but one map.
    const std::size_t maps = tables.rows == 1 ? 1 : (tables.rows + 4) / 5 * 5;
    const std::size_t texels = size * size;
    Texture texture = layered_texture(name, std::uint32_t(width), maps * layers);
    for (std::size_t row = 0; row < tables.rows; ++row)
      for (std::size_t t = 0; t < tables.texels; ++t) {
        const std::size_t layer = t / texels * maps + row;
        float* texel = texture.texels.data() + (layer * texels + t % texels) * 4;
        for (std::size_t c = 0; c < 3; ++c) texel[c] = values(row, c)[t];
        texel[3] = 1;
      }
    return texture;
  }
  const std::size_t first = mean ? 1 : 0, quads = (tables.rows - first) / 4, left = (tables.rows - first) % 4;
  TWINSHADE_CHECK_LE(left, std::size_t(1));
  Texture texture = packed_texture(name, layers * size, (first + 3 * quads + left) * size, "make the map narrower");
  const auto put_row = [&](std::size_t band, std::size_t row) {
    for (std::size_t c = 0; c < 3; ++c) put_band(texture, band, c, size, layers, values(row, c));
  };
  if (mean) put_row(0, 0);
  for (std::size_t quad = 0; quad < quads; ++quad)
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t i = 0; i < 4; ++i)
        put_band(texture, first + 3 * quad + c, i, size, layers, values(first + 4 * quad + i, c));
  if (left) put_row(first + 3 * quads, first + 4 * quads);
  return texture;
}

}  // namespace twinshade
