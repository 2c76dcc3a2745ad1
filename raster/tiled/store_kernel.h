// Colours from structures of arrays to a tile's RGBA pixels.
#pragma once

#include "cpu_shaders/runtime/numbers.h"
#include "cpu_shaders/runtime/texel_load.h"
#include "raster/tiled/kernels.h"

namespace twinshade::tiled {
inline namespace TWINSHADE_ISA_NAMESPACE {

// [m]: ~0 in the four channels of pixel i where bit i of m is set.
struct PixelMasks {
  alignas(64) std::uint32_t of[16][4][4];
  constexpr PixelMasks() : of{} {
    for (std::uint32_t m = 0; m < 16; ++m)
      for (std::uint32_t k = 0; k < 16; ++k) of[m][k / 4][k % 4] = m >> (k / 4) & 1 ? ~0u : 0u;
  }
};
inline constexpr PixelMasks kPixelMasks;

// One quad is four neighbours in both memories. No branches: which pixels are covered cannot be predicted.
inline void store_quads(const StoreQuads& call) {
  using U4 = Register<std::uint32_t, 4>;
  static constexpr float kZeros[4] = {};
  const float* channels[4];
  std::uint32_t step[4];
  for (int c = 0; c < 4; ++c) {
    channels[c] = call.channels[c] ? call.channels[c] : kZeros;
    step[c] = call.channels[c] ? 1 : 0;
  }
  const std::uint32_t* const tile_quads = call.tile_quads;
  const std::uint32_t* const coverage = call.coverage;
  float* const color = call.color;
  for (std::uint32_t q = 0, count = call.count; q < count; ++q) {
    Float4 pixels[4];
    for (int c = 0; c < 4; ++c) pixels[c] = registers::load_texel(channels[c], q * step[c]);
    registers::transpose_groups(pixels);
    float* const to = color + 16 * std::size_t{tile_quads[q]};
    for (int i = 0; i < 4; ++i) {
      U4 mask, before, after;
      std::memcpy(&mask, kPixelMasks.of[coverage[q]][i], sizeof mask);
      std::memcpy(&before, to + 4 * i, sizeof before);
      std::memcpy(&after, &pixels[i], sizeof after);
      after = (after & mask) | (before & ~mask);
      std::memcpy(to + 4 * i, &after, sizeof after);
    }
  }
}

}  // namespace TWINSHADE_ISA_NAMESPACE
}  // namespace twinshade::tiled
