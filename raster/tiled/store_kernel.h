// Colours from structures of arrays to a tile's RGBA pixels.
#pragma once

#include "cpu_shaders/runtime/numbers.h"
#include "cpu_shaders/runtime/texel_load.h"
#include "raster/tiled/kernels.h"

namespace twinshade::tiled {
inline namespace TWINSHADE_ISA_NAMESPACE {

inline void store_colors(const StoreColors& call) {
  static constexpr float kZeros[8] = {};
  const float* channels[4];
  std::size_t step[4];
  for (int c = 0; c < 4; ++c) {
    channels[c] = call.channels[c] ? call.channels[c] : kZeros;
    step[c] = call.channels[c] ? 1 : 0;
  }
  const std::uint32_t* const pixels = call.pixels;
  float* const color = call.color;
  const auto store = [&](std::size_t i, const Float4& rgba)
                         TWINSHADE_LAMBDA { std::memcpy(color + 4 * std::size_t{pixels[i]}, &rgba, sizeof rgba); };
  const std::size_t count = call.count;
  std::size_t begin = 0;
  if constexpr (Simd<float, 8>::whole)
    for (; begin + 8 <= count; begin += 8) {
      Float8 rgba[4];  // [j]: of invocations j and 4 + j
      for (int c = 0; c < 4; ++c) rgba[c] = registers::load<8>(channels[c] + begin * step[c]);
      registers::transpose_groups(rgba);
      for (std::size_t j = 0; j < 4; ++j) store(begin + j, __builtin_shufflevector(rgba[j], rgba[j], 0, 1, 2, 3));
      for (std::size_t j = 0; j < 4; ++j) store(begin + 4 + j, __builtin_shufflevector(rgba[j], rgba[j], 4, 5, 6, 7));
    }
  for (; begin < count; begin += 4) {
    Float4 rgba[4];
    for (int c = 0; c < 4; ++c) rgba[c] = registers::load<4>(channels[c] + begin * step[c]);
    registers::transpose_groups(rgba);
    if (begin + 4 <= count)
      for (std::size_t i = 0; i < 4; ++i) store(begin + i, rgba[i]);
    else
      for (std::size_t i = 0; begin + i < count; ++i) store(begin + i, rgba[i]);
  }
}

}  // namespace TWINSHADE_ISA_NAMESPACE
}  // namespace twinshade::tiled
