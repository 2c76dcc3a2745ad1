#include "experiments/sphere_map_drawing.h"

#include <algorithm>

#include "base/error.h"

namespace twinshade {
namespace {

constexpr std::uint32_t kDrawingWidth = 256;
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

// RGBA of four functions from `first` on, zero beyond the last.
std::vector<float> four_functions(std::span<const float> texels, int functions, int first) {
  const std::size_t stride = std::size_t(functions), count = texels.size() / stride;
  std::vector<float> rgba(count * 4, 0.0f);
  for (std::size_t texel = 0; texel < count; ++texel)
    for (int k = first; k < std::min(first + kPerFrame, functions); ++k)
      rgba[texel * 4 + std::size_t(k - first)] = texels[texel * stride + std::size_t(k)];
  return rgba;
}

}  // namespace

std::vector<float> draw_reads(const std::string& machine, const DrawFunction& draw, const SphereMapGrid& grid,
                              MapFilter filter, std::span<const float> texels, int functions,
                              std::span<const glm::vec3> directions) {
  TWINSHADE_CHECK_EQ(texels.size(), std::size_t(grid.texels()) * std::size_t(functions));
  const SphereMapInfo& map = grid.map();
  const std::uint32_t height = std::uint32_t((directions.size() + kDrawingWidth - 1) / kDrawingWidth);
  Bundle bundle = whole_frame(kDrawingWidth, height);

  Texture looks{"directions", TextureKind::two_d, kDrawingWidth, height, 1, Filter::nearest, Wrap::clamp_to_edge, {}};
  looks.texels.assign(std::size_t(kDrawingWidth) * height * 4, 1.0f);
  for (std::size_t i = 0; i < directions.size(); ++i)
    for (int c = 0; c < 3; ++c) looks.texels[4 * i + std::size_t(c)] = directions[i][c];
  bundle.textures.push_back(std::move(looks));

  const bool own = filter == MapFilter::written_out;
  const std::uint32_t width = std::uint32_t(grid.width());
  Texture& maps = bundle.textures.emplace_back();
  maps.name = "maps";
  maps.kind = !own && map.is_cube() ? TextureKind::cube : TextureKind::two_d_array;
  maps.width = maps.height = width, maps.layers = std::uint32_t(map.layers);
  maps.wrap = filter == MapFilter::driver_seamless ? Wrap::repeat : Wrap::clamp_to_edge;

  const ShaderSource source = own ? sphere_map_read_source(map) : sphere_map_driver_source(map);
  std::vector<float> reads(directions.size() * std::size_t(functions));
  for (int first = 0; first < functions; first += kPerFrame) {
    maps.texels = four_functions(texels, functions, first);
    const Frame frame = draw(machine, bundle, source);
    const int last = std::min(first + kPerFrame, functions);
    for (std::size_t i = 0; i < directions.size(); ++i)
      for (int k = first; k < last; ++k)
        reads[i * std::size_t(functions) + std::size_t(k)] = frame.color[4 * i + std::size_t(k - first)];
  }
  return reads;
}

}  // namespace twinshade
