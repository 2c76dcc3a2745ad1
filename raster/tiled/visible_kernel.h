// What is visible in a tile, by blocks of 4 x 4 pixels, and its pixels one after another.
#pragma once

#if defined(__AVX2__)
#include <immintrin.h>
#endif

#include "cpu_shaders/runtime/numbers.h"
#include "raster/tiled/kernels.h"

namespace twinshade::tiled {
inline namespace TWINSHADE_ISA_NAMESPACE {

// Of blocks, those in which their triangle shows, with their coverage, closed up. Returns how many are left.
// found(triangle, block, which of its pixels show it) returns what becomes of the triangle's number.
template <class Found>
TWINSHADE_INLINE std::uint32_t keep_visible(const CoverTile& tile, std::uint32_t count, Found found) {
  using U = Simd<std::uint32_t, 16>;
  VisibleBlock* const blocks = tile.blocks;
  const std::uint32_t* const visible = tile.visible;
  std::uint32_t kept = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t triangle = blocks[i].local, block = blocks[i].block;
    const auto shows = U::load(visible + 16 * std::size_t{block}) == U(triangle);
    const std::uint32_t coverage = shows.bits();
    blocks[kept] = {found(triangle, block, shows), std::uint16_t(block), std::uint16_t(coverage)};
    kept += coverage != 0;  // written over by the next one unless it shows, which no processor can predict
  }
  return kept;
}

template <bool ids>
TWINSHADE_INLINE std::uint32_t collect_visible_if(const CollectVisible& call) {
  using U = Simd<std::uint32_t, 16>;
  const CoverTile& tile = *call.tile;
  const U not_visible(kNotVisible), no_primitive(call.no_primitive);
  for (std::uint32_t block = 0, blocks = tile.size * tile.size / 16; block < blocks; ++block) {
    if ((U::load(tile.visible + 16 * block) == not_visible).bits() != 0) {
      float* color = call.color + 64 * std::size_t{block};
      for (int i = 0; i < 64; i += 16) Simd<float, 16>(0.0f).store(color + i);
    }
    if constexpr (ids) no_primitive.store(call.primitive_id + 16 * block);
  }
  const std::uint32_t* const locals = tile.locals;
  return keep_visible(tile, call.block_count,
                      [&](std::uint32_t triangle, std::uint32_t block, const auto& shows) TWINSHADE_LAMBDA {
                        const std::uint32_t local = locals[triangle];
                        if constexpr (ids) {
                          std::uint32_t* const id = call.primitive_id + 16 * std::size_t{block};
                          select(shows, U(tile.primitives[local].primitive), U::load(id)).store(id);
                        }
                        return local;
                      });
}

inline std::uint32_t collect_visible(const CollectVisible& call) {
  return call.primitive_id ? collect_visible_if<true>(call) : collect_visible_if<false>(call);
}

// [m]: the bits that are set in m, the lowest first.
struct SetBits {
  alignas(64) std::uint8_t of[256][8];
  constexpr SetBits() : of{} {
    for (std::uint32_t m = 0; m < 256; ++m)
      for (std::uint32_t i = 0, count = 0; i < 8; ++i)
        if (m >> i & 1) of[m][count++] = std::uint8_t(i);
  }
};
inline constexpr SetBits kSetBits;

#if defined(__AVX2__)
TWINSHADE_INLINE Int8 set_bits(std::uint32_t m) {
  return (Int8)_mm256_cvtepu8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(kSetBits.of[m])));
}
#endif

// Writes `first` + i for each bit i that is set, and up to 16 words in all. Returns how many bits were.
TWINSHADE_INLINE std::uint32_t write_set_bits(std::uint32_t first, std::uint32_t bits, std::uint32_t* to) {
#if defined(__AVX512F__)
  const __m512i lanes = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
  const __m512i numbers = _mm512_add_epi32(lanes, _mm512_set1_epi32(static_cast<int>(first)));
  _mm512_storeu_si512(to, _mm512_maskz_compress_epi32(static_cast<__mmask16>(bits), numbers));
  return static_cast<std::uint32_t>(__builtin_popcount(bits));
#else
  const std::uint32_t low = bits & 0xffu, count = static_cast<std::uint32_t>(__builtin_popcount(low));
  const auto write = [](std::uint32_t from, std::uint32_t m, std::uint32_t* numbers) TWINSHADE_LAMBDA {
#if defined(__AVX2__)
    registers::store(numbers, Register<std::uint32_t, 8>(set_bits(m)) + from);
#else
    std::uint8_t set[8];
    std::memcpy(set, kSetBits.of[m], sizeof set);
    for (int i = 0; i < 8; ++i) numbers[i] = from + set[i];
#endif
  };
  write(first, low, to);
  write(first + 8, bits >> 8, to + count);
  return count + static_cast<std::uint32_t>(__builtin_popcount(bits >> 8));
#endif
}

// Writes the numbers, of sixteen, whose bits are set, and up to 16 in all.
TWINSHADE_INLINE void write_where_set(const float* numbers, std::uint32_t bits, float* to) {
#if defined(__AVX512F__)
  _mm512_storeu_ps(to, _mm512_maskz_compress_ps(static_cast<__mmask16>(bits), _mm512_loadu_ps(numbers)));
#else
  const auto write = [](const float* eight, std::uint32_t m, float* out) TWINSHADE_LAMBDA {
#if defined(__AVX2__)
    registers::store(out, Float8(registers::permute8(Int8(registers::load<8>(eight)), set_bits(m))));
#else
    for (int i = 0; i < 8; ++i) out[i] = eight[kSetBits.of[m][i]];
#endif
  };
  write(numbers, bits & 0xffu, to);
  write(numbers + 8, bits >> 8, to + __builtin_popcount(bits & 0xffu));
#endif
}

// add(block, its number, invocations so far) for blocks until there are enough, and a run for each primitive; returns
// how many invocations it added.
template <class Add>
TWINSHADE_INLINE std::size_t add_blocks(AddCovered& call, Add add) {
  const VisibleBlock* const blocks = call.blocks;
  ShadeRun* const runs = call.runs;
  const std::size_t block_count = call.block_count;
  const std::uint32_t enough = call.enough;
  std::uint32_t count = call.count, run_count = call.run_count;
  std::uint32_t last = run_count == 0 ? 0 : runs[run_count - 1].local;
  std::size_t taken = 0;
  for (; taken < block_count && count < enough; ++taken) {
    const VisibleBlock block = blocks[taken];
    const bool begins = run_count == 0 || last != block.local;
    // Written over by the next one unless it begins a run, which no processor can predict.
    runs[run_count] = {block.local, count};
    run_count += begins;
    last = block.local;
    count += add(block, taken, count);
  }
  call.count = count;
  call.run_count = run_count;
  return taken;
}

template <bool with_depths>
TWINSHADE_INLINE std::size_t add_covered_if(AddCovered& call) {
  std::uint32_t* const pixels = call.pixels;
  const float* const block_depths = call.block_depths;
  float* const depths = call.depths;
  return add_blocks(call, [=](VisibleBlock block, std::size_t number, std::uint32_t count) TWINSHADE_LAMBDA {
    if constexpr (with_depths) write_where_set(block_depths + 16 * number, block.coverage, depths + count);
    return write_set_bits(16u * block.block, block.coverage, pixels + count);
  });
}

inline std::size_t add_covered(AddCovered& call) {
  return call.block_depths ? add_covered_if<true>(call) : add_covered_if<false>(call);
}

// [m]: words of all bits where m has its bits 0 to 3.
alignas(64) inline constexpr std::uint32_t kWords[16][4] = {
    {0, 0, 0, 0},     {~0u, 0, 0, 0},     {0, ~0u, 0, 0},     {~0u, ~0u, 0, 0},    {0, 0, ~0u, 0},   {~0u, 0, ~0u, 0},
    {0, ~0u, ~0u, 0}, {~0u, ~0u, ~0u, 0}, {0, 0, 0, ~0u},     {~0u, 0, 0, ~0u},    {0, ~0u, 0, ~0u}, {~0u, ~0u, 0, ~0u},
    {0, 0, ~0u, ~0u}, {~0u, 0, ~0u, ~0u}, {0, ~0u, ~0u, ~0u}, {~0u, ~0u, ~0u, ~0u}};

template <bool with_depths>
TWINSHADE_INLINE std::size_t add_quads_if(AddCovered& call) {
  using U = Register<std::uint32_t, 4>;
  std::uint32_t* const pixels = call.pixels;
  std::uint32_t* const live = call.live;
  const float* const block_depths = call.block_depths;
  float* const depths = call.depths;
  return add_blocks(call, [=](VisibleBlock block, std::size_t number, std::uint32_t count) TWINSHADE_LAMBDA {
    const std::uint32_t before = count;
    for (std::uint32_t quad = 0; quad < 4; ++quad) {  // all are written; those that are not covered, over
      const std::uint32_t coverage = block.coverage >> (4 * quad) & 15u;
      registers::store(pixels + count, U{0, 1, 2, 3} + (16u * block.block + 4 * quad));
      registers::store(live + count, registers::load<4>(kWords[coverage]));
      if constexpr (with_depths)
        registers::store(depths + count, registers::load<4>(block_depths + 16 * number + 4 * quad));
      count += coverage == 0 ? 0 : 4;
    }
    return count - before;
  });
}

inline std::size_t add_quads(AddCovered& call) {
  return call.block_depths ? add_quads_if<true>(call) : add_quads_if<false>(call);
}

}  // namespace TWINSHADE_ISA_NAMESPACE
}  // namespace twinshade::tiled
