#include "experiments/sphere_map_drawing.h"

#include <algorithm>
#include <bit>

#include "base/error.h"

namespace twinshade {
namespace {

constexpr std::uint32_t kFrameWidth = 256;
constexpr int kPerFrame = 4;  // functions that a pixel's four channels hold

// Two triangles over the whole frame.
Bundle whole_frame(std::uint32_t width, std::uint32_t height) {
  Bundle bundle;
  bundle.width = width, bundle.height = height;
  bundle.clip_positions = {-1, -1, 0, 1, 1, -1, 0, 1, 1, 1, 0, 1, -1, 1, 0, 1};
  fit_to_viewport(bundle.clip_positions, width, height);
  bundle.indices = {0, 1, 2, 0, 2, 3};
  return bundle;
}

Uniform whole_number(const char* name, int value) {
  return {name, Scalar::i32, 1, 1, 0, {std::bit_cast<float>(value)}};
}

}  // namespace

std::vector<float> draw_reads(const std::string& machine, const DrawFunction& draw, const SphereMapGrid& grid,
                              std::span<const float> texels, int functions, std::span<const glm::vec3> directions) {
  TWINSHADE_CHECK_EQ(texels.size(), std::size_t(grid.texels()) * std::size_t(functions));
  const std::uint32_t height = std::uint32_t((directions.size() + kFrameWidth - 1) / kFrameWidth);
  Bundle bundle = whole_frame(kFrameWidth, height);

  Texture looks{"directions", TextureKind::two_d, kFrameWidth, height, 1, Filter::nearest, Wrap::clamp_to_edge, {}};
  looks.texels.assign(std::size_t(kFrameWidth) * height * 4, 1.0f);
  for (std::size_t i = 0; i < directions.size(); ++i)
    for (int c = 0; c < 3; ++c) looks.texels[4 * i + std::size_t(c)] = directions[i][c];
  bundle.textures.push_back(std::move(looks));

  const int groups = (functions + kPerFrame - 1) / kPerFrame, layers = grid.map().layers;
  const std::uint32_t width = std::uint32_t(grid.width());
  Texture maps{"maps",          TextureKind::two_d_array, width, width, std::uint32_t(groups * layers),
               Filter::nearest, Wrap::clamp_to_edge,      {}};
  const std::size_t map_texels = std::size_t(grid.texels());
  maps.texels.assign(std::size_t(groups) * map_texels * 4, 0.0f);
  for (std::size_t texel = 0; texel < map_texels; ++texel)
    for (int k = 0; k < functions; ++k)
      maps.texels[(std::size_t(k / kPerFrame) * map_texels + texel) * 4 + std::size_t(k % kPerFrame)] =
          texels[texel * std::size_t(functions) + std::size_t(k)];
  bundle.textures.push_back(std::move(maps));
  bundle.uniforms = {whole_number("width", grid.width()), whole_number("first_layer", 0)};

  const ShaderSource source = sphere_map_read_source(grid.map());
  std::vector<float> reads(directions.size() * std::size_t(functions));
  for (int group = 0; group < groups; ++group) {
    bundle.uniforms[1] = whole_number("first_layer", group * layers);
    const Frame frame = draw(machine, bundle, source);
    const int first = group * kPerFrame, last = std::min(first + kPerFrame, functions);
    for (std::size_t i = 0; i < directions.size(); ++i)
      for (int k = first; k < last; ++k)
        reads[i * std::size_t(functions) + std::size_t(k)] = frame.color[4 * i + std::size_t(k - first)];
  }
  return reads;
}

}  // namespace twinshade
