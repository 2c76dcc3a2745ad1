// What GCC's vector extensions do not give: square root, rounding, any/all, conversions, gathers and permutes of one
// register of 4, 8 or 16 32-bit lanes. x86-64 from v2 to v4 and NEON; elsewhere one lane at a time.
#pragma once

#include <utility>

#include "cpu_shaders/runtime/number.h"

namespace twinshade {
inline namespace TWINSHADE_ISA_NAMESPACE {

template <class E, int W>
struct RegisterOf {
  typedef E type __attribute__((vector_size(W * sizeof(E))));
};
template <class E, int W>
using Register = typename RegisterOf<E, W>::type;
// The same anywhere in memory.
template <class E, int W>
struct RegisterInMemoryOf {
  typedef E type __attribute__((vector_size(W * sizeof(E)), aligned(alignof(E)), may_alias));
};

using Float4 = Register<float, 4>;
using Int4 = Register<std::int32_t, 4>;
using Float8 = Register<float, 8>;
using Int8 = Register<std::int32_t, 8>;
using Float16 = Register<float, 16>;
using Int16 = Register<std::int32_t, 16>;

namespace registers {

template <class E, int W, std::size_t... k>
TWINSHADE_INLINE Register<E, W> splat(E x, std::index_sequence<k...>) {
  return Register<E, W>{(static_cast<void>(k), x)...};
}
template <class E, int W>
TWINSHADE_INLINE Register<E, W> splat(E x) {
  return splat<E, W>(x, std::make_index_sequence<W>());
}

// Not by memcpy, which GCC does by 16 bytes where it only moves numbers from here to there: loads of a whole register
// wait for such stores.
template <int W, class E>
TWINSHADE_INLINE Register<E, W> load(const E* from) {
  return *reinterpret_cast<const typename RegisterInMemoryOf<E, W>::type*>(from);
}
template <class E, class V>
TWINSHADE_INLINE void store(E* to, const V& numbers) {
  *reinterpret_cast<typename RegisterInMemoryOf<E, sizeof(V) / sizeof(E)>::type*>(to) = numbers;
}

// Loops over lanes for targets without the instruction.
template <class V, class F>
TWINSHADE_INLINE V by_lane(V x, F f) {
  V r;
  for (std::size_t i = 0; i < sizeof(V) / 4; ++i) r[i] = f(x[i]);
  return r;
}

// --- square root and rounding

TWINSHADE_INLINE Float4 sqrt(Float4 x) {
#if defined(__SSE2__)
  return (Float4)_mm_sqrt_ps((__m128)x);
#elif defined(__aarch64__)
  return (Float4)vsqrtq_f32((float32x4_t)x);
#else
  return by_lane(x, number::square_root<float>);
#endif
}
TWINSHADE_INLINE Float4 floor(Float4 x) {
#if defined(__SSE4_1__)
  return (Float4)_mm_floor_ps((__m128)x);
#elif defined(__aarch64__)
  return (Float4)vrndmq_f32((float32x4_t)x);
#else
  return by_lane(x, number::round_down<float>);
#endif
}
TWINSHADE_INLINE Float4 ceil(Float4 x) {
#if defined(__SSE4_1__)
  return (Float4)_mm_ceil_ps((__m128)x);
#elif defined(__aarch64__)
  return (Float4)vrndpq_f32((float32x4_t)x);
#else
  return by_lane(x, number::round_up<float>);
#endif
}
TWINSHADE_INLINE Float4 trunc(Float4 x) {
#if defined(__SSE4_1__)
  return (Float4)_mm_round_ps((__m128)x, _MM_FROUND_TO_ZERO | _MM_FROUND_NO_EXC);
#elif defined(__aarch64__)
  return (Float4)vrndq_f32((float32x4_t)x);
#else
  return by_lane(x, number::round_to_zero<float>);
#endif
}
TWINSHADE_INLINE Float4 round_even(Float4 x) {
#if defined(__SSE4_1__)
  return (Float4)_mm_round_ps((__m128)x, _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC);
#elif defined(__aarch64__)
  return (Float4)vrndnq_f32((float32x4_t)x);
#else
  return by_lane(x, number::round_to_even<float>);
#endif
}

// --- float to int: towards zero, clamped, NaN gives 0 (what NEON does by itself)

TWINSHADE_INLINE Int4 to_int(Float4 x) {
#if defined(__SSE2__)
  // Out of range and NaN give INT_MIN; above, flip to INT_MAX.
  return ((Int4)_mm_cvttps_epi32((__m128)x) ^ (x >= splat<float, 4>(2147483648.0f))) & (x == x);
#elif defined(__aarch64__)
  return (Int4)vcvtq_s32_f32((float32x4_t)x);
#else
  Int4 r;
  for (int i = 0; i < 4; ++i) r[i] = number::convert<std::int32_t>(x[i]);
  return r;
#endif
}

// --- comparisons: lanes 0 or -1

template <class V>
TWINSHADE_INLINE auto less(V x, V y) {
  return x < y;
}
template <class V>
TWINSHADE_INLINE auto greater(V x, V y) {
  return x > y;
}
template <class V>
TWINSHADE_INLINE auto less_equal(V x, V y) {
  return x <= y;
}
template <class V>
TWINSHADE_INLINE auto greater_equal(V x, V y) {
  return x >= y;
}
template <class V>
TWINSHADE_INLINE auto equal(V x, V y) {
  return x == y;
}
template <class V>
TWINSHADE_INLINE auto not_equal(V x, V y) {
  return x != y;
}
// x where the lane is -1, else y.
template <class M, class V>
TWINSHADE_INLINE V blend(M lanes, V x, V y) {
  return lanes ? x : y;
}
// As number::minimum and number::maximum.
template <class V>
TWINSHADE_INLINE V lesser(V x, V y) {
  return x < y ? x : y;
}
template <class V>
TWINSHADE_INLINE V larger(V x, V y) {
  return x > y ? x : y;
}
TWINSHADE_INLINE Float4 lesser(Float4 x, Float4 y) {
#if defined(__SSE2__)
  return y != y ? x : (Float4)_mm_min_ps((__m128)x, (__m128)y);
#else
  return y != y ? x : (x < y ? x : y) * splat<float, 4>(number::unknown_one<float>());
#endif
}
TWINSHADE_INLINE Float4 larger(Float4 x, Float4 y) {
#if defined(__SSE2__)
  return y != y ? x : (Float4)_mm_max_ps((__m128)x, (__m128)y);
#else
  return y != y ? x : (x > y ? x : y) * splat<float, 4>(number::unknown_one<float>());
#endif
}

#if defined(__SSE4_1__)
TWINSHADE_INLINE Int4 lesser(Int4 x, Int4 y) { return (Int4)_mm_min_epi32((__m128i)x, (__m128i)y); }
TWINSHADE_INLINE Int4 larger(Int4 x, Int4 y) { return (Int4)_mm_max_epi32((__m128i)x, (__m128i)y); }
#endif

// --- masks (lanes 0 or -1)

TWINSHADE_INLINE bool any(Int4 m) {
#if defined(__SSE2__)
  return _mm_movemask_ps((__m128)m) != 0;
#elif defined(__aarch64__)
  return vmaxvq_u32((uint32x4_t)m) != 0;
#else
  return (m[0] | m[1] | m[2] | m[3]) != 0;
#endif
}
TWINSHADE_INLINE bool all(Int4 m) {
#if defined(__SSE2__)
  return _mm_movemask_ps((__m128)m) == 15;
#elif defined(__aarch64__)
  return vminvq_u32((uint32x4_t)m) != 0;
#else
  return (m[0] & m[1] & m[2] & m[3]) != 0;
#endif
}
// Bit i is lane i.
TWINSHADE_INLINE std::uint32_t mask_bits(Int4 m) {
#if defined(__SSE2__)
  return static_cast<std::uint32_t>(_mm_movemask_ps((__m128)m));
#else
  return (m[0] & 1u) | (m[1] & 2u) | (m[2] & 4u) | (m[3] & 8u);
#endif
}

#if defined(__AVX2__)
TWINSHADE_INLINE Float8 sqrt(Float8 x) { return (Float8)_mm256_sqrt_ps((__m256)x); }
TWINSHADE_INLINE Float8 floor(Float8 x) { return (Float8)_mm256_floor_ps((__m256)x); }
TWINSHADE_INLINE Float8 ceil(Float8 x) { return (Float8)_mm256_ceil_ps((__m256)x); }
TWINSHADE_INLINE Float8 trunc(Float8 x) {
  return (Float8)_mm256_round_ps((__m256)x, _MM_FROUND_TO_ZERO | _MM_FROUND_NO_EXC);
}
TWINSHADE_INLINE Float8 round_even(Float8 x) {
  return (Float8)_mm256_round_ps((__m256)x, _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC);
}
TWINSHADE_INLINE Int8 to_int(Float8 x) {
  return ((Int8)_mm256_cvttps_epi32((__m256)x) ^ (x >= splat<float, 8>(2147483648.0f))) & (x == x);
}
TWINSHADE_INLINE Float8 lesser(Float8 x, Float8 y) { return y != y ? x : (Float8)_mm256_min_ps((__m256)x, (__m256)y); }
TWINSHADE_INLINE Float8 larger(Float8 x, Float8 y) { return y != y ? x : (Float8)_mm256_max_ps((__m256)x, (__m256)y); }
TWINSHADE_INLINE Int8 lesser(Int8 x, Int8 y) { return (Int8)_mm256_min_epi32((__m256i)x, (__m256i)y); }
TWINSHADE_INLINE Int8 larger(Int8 x, Int8 y) { return (Int8)_mm256_max_epi32((__m256i)x, (__m256i)y); }
template <class V>
TWINSHADE_INLINE V blend(Int8 lanes, V x, V y) {
  return (V)_mm256_blendv_ps((__m256)y, (__m256)x, (__m256)lanes);
}
TWINSHADE_INLINE bool any(Int8 m) { return _mm256_movemask_ps((__m256)m) != 0; }
TWINSHADE_INLINE bool all(Int8 m) { return _mm256_movemask_ps((__m256)m) == 255; }
TWINSHADE_INLINE std::uint32_t mask_bits(Int8 m) { return static_cast<std::uint32_t>(_mm256_movemask_ps((__m256)m)); }
#endif

// The maskz forms with all lanes set: g++ 12 warns of an uninitialised value inside its own header for the plain ones.
#if defined(__AVX512F__)
TWINSHADE_INLINE Float16 sqrt(Float16 x) { return (Float16)_mm512_maskz_sqrt_ps(0xffff, (__m512)x); }
TWINSHADE_INLINE Float16 floor(Float16 x) {
  return (Float16)_mm512_maskz_roundscale_ps(0xffff, (__m512)x, _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC);
}
TWINSHADE_INLINE Float16 ceil(Float16 x) {
  return (Float16)_mm512_maskz_roundscale_ps(0xffff, (__m512)x, _MM_FROUND_TO_POS_INF | _MM_FROUND_NO_EXC);
}
TWINSHADE_INLINE Float16 trunc(Float16 x) {
  return (Float16)_mm512_maskz_roundscale_ps(0xffff, (__m512)x, _MM_FROUND_TO_ZERO | _MM_FROUND_NO_EXC);
}
TWINSHADE_INLINE Float16 round_even(Float16 x) {
  return (Float16)_mm512_maskz_roundscale_ps(0xffff, (__m512)x, _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC);
}
TWINSHADE_INLINE Int16 to_int(Float16 x) {
  return ((Int16)_mm512_maskz_cvttps_epi32(0xffff, (__m512)x) ^ (x >= splat<float, 16>(2147483648.0f))) & (x == x);
}
TWINSHADE_INLINE __mmask16 mask_of(Int16 lanes) { return _mm512_movepi32_mask((__m512i)lanes); }

// Comparisons of sixteen lanes give a mask register: bit i is lane i.
using UInt16 = Register<std::uint32_t, 16>;
#define TWINSHADE_COMPARISON(name, of_floats, of_integers)             \
  TWINSHADE_INLINE __mmask16 name(Float16 x, Float16 y) {              \
    return _mm512_cmp_ps_mask((__m512)x, (__m512)y, of_floats);        \
  }                                                                    \
  TWINSHADE_INLINE __mmask16 name(Int16 x, Int16 y) {                  \
    return _mm512_cmp_epi32_mask((__m512i)x, (__m512i)y, of_integers); \
  }                                                                    \
  TWINSHADE_INLINE __mmask16 name(UInt16 x, UInt16 y) {                \
    return _mm512_cmp_epu32_mask((__m512i)x, (__m512i)y, of_integers); \
  }
TWINSHADE_COMPARISON(less, _CMP_LT_OQ, _MM_CMPINT_LT)
TWINSHADE_COMPARISON(less_equal, _CMP_LE_OQ, _MM_CMPINT_LE)
TWINSHADE_COMPARISON(equal, _CMP_EQ_OQ, _MM_CMPINT_EQ)
TWINSHADE_COMPARISON(not_equal, _CMP_NEQ_UQ, _MM_CMPINT_NE)
TWINSHADE_COMPARISON(greater, _CMP_GT_OQ, _MM_CMPINT_NLE)
TWINSHADE_COMPARISON(greater_equal, _CMP_GE_OQ, _MM_CMPINT_NLT)
#undef TWINSHADE_COMPARISON
// x where the bit is set, else y.
template <class V>
requires(sizeof(V) == 64) TWINSHADE_INLINE V blend(__mmask16 m, V x, V y) {
  return (V)_mm512_mask_blend_epi32(m, (__m512i)y, (__m512i)x);
}
// Compilers make one masked instruction of it, and leave the mask out where y is constant.
TWINSHADE_INLINE Float16 lesser(Float16 x, Float16 y) {
  return y != y ? x : (Float16)_mm512_maskz_min_ps(0xffff, (__m512)x, (__m512)y);
}
TWINSHADE_INLINE Float16 larger(Float16 x, Float16 y) {
  return y != y ? x : (Float16)_mm512_maskz_max_ps(0xffff, (__m512)x, (__m512)y);
}
TWINSHADE_INLINE Int16 lesser(Int16 x, Int16 y) {
  return (Int16)_mm512_maskz_min_epi32(0xffff, (__m512i)x, (__m512i)y);
}
TWINSHADE_INLINE Int16 larger(Int16 x, Int16 y) {
  return (Int16)_mm512_maskz_max_epi32(0xffff, (__m512i)x, (__m512i)y);
}
#endif

// --- memory by index: base[index] in each lane; indices are in range

template <class E, int W>
TWINSHADE_INLINE Register<E, W> gather(const E* base, Register<std::int32_t, W> index) {
#if defined(__AVX512F__)
  if constexpr (W == 16)
    return (Register<E, W>)_mm512_mask_i32gather_epi32(_mm512_setzero_si512(), 0xffff, (__m512i)index, base, 4);
#endif
#if defined(__AVX2__)
  if constexpr (W == 8)
    return (Register<E, W>)_mm256_i32gather_epi32(reinterpret_cast<const int*>(base), (__m256i)index, 4);
#endif
  Register<E, W> r;
  for (int i = 0; i < W; ++i) r[i] = base[index[i]];
  return r;
}

// --- tables held in registers

#if defined(__AVX2__)
TWINSHADE_INLINE Int8 permute8(Int8 table, Int8 index) {  // table[index & 7]
  return (Int8)_mm256_permutevar8x32_epi32((__m256i)table, (__m256i)index);
}
TWINSHADE_INLINE Int8 permute16(Int8 low, Int8 high, Int8 index) {
  return (index & 8) != 0 ? permute8(high, index) : permute8(low, index);
}
#endif
#if defined(__AVX512F__)
TWINSHADE_INLINE Int16 permute32(Int16 low, Int16 high, Int16 index) {
  return (Int16)_mm512_maskz_permutex2var_epi32(0xffff, (__m512i)low, (__m512i)index, (__m512i)high);
}
TWINSHADE_INLINE Int16 permute16(Int16 table, Int16 index) {
  return (Int16)_mm512_maskz_permutexvar_epi32(0xffff, (__m512i)index, (__m512i)table);
}
#endif

}  // namespace registers
}  // namespace TWINSHADE_ISA_NAMESPACE
}  // namespace twinshade
