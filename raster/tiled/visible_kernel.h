// What is visible in a tile, by blocks of 4 x 4 pixels.
#pragma once

#include "cpu_shaders/runtime/numbers.h"
#include "raster/tiled/kernels.h"

namespace twinshade::tiled {
inline namespace TWINSHADE_ISA_NAMESPACE {

inline std::uint32_t collect_visible(const CollectVisible& call) {
  using U = Simd<std::uint32_t, 16>;
  const CoverTile& tile = *call.tile;
  VisibleBlock* found = call.found;
  for (std::uint32_t block = 0, blocks = tile.size * tile.size / 16; block < blocks; ++block) {
    const std::uint32_t* pixels = tile.visible + 16 * block;
    const U visible = U::load(pixels);
    std::uint32_t left = (visible != U(kNotVisible)).bits();
    if (left != 0xffff) {
      float* color = call.color + 64 * std::size_t{block};
      for (int i = 0; i < 64; i += 16) Simd<float, 16>(0.0f).store(color + i);
    }
    U id(call.no_primitive);
    while (left != 0) {
      const std::uint32_t local = pixels[__builtin_ctz(left)];
      const auto here = visible == U(local);
      const std::uint32_t coverage = here.bits();
      left &= ~coverage;
      id = select(here, U(tile.primitives[local].primitive), id);
      *found++ = {local, std::uint16_t(block), std::uint16_t(coverage)};
      ++call.counts[local + 1];
    }
    id.store(call.primitive_id + 16 * block);
  }
  return std::uint32_t(found - call.found);
}

}  // namespace TWINSHADE_ISA_NAMESPACE
}  // namespace twinshade::tiled
