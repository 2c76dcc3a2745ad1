// Which instruction set this translation unit is built for, and the namespace that keeps its code apart: inline
// functions of an AVX-512 object must never win at link time over those of the baseline, so everything in the runtime
// and in generated code lives in an inline namespace named after the instruction set.
#pragma once

#if defined(__x86_64__)
#include <immintrin.h>
#elif defined(__aarch64__)
#include <arm_neon.h>
#endif

#define TWINSHADE_JOIN_(a, b) a##b
#define TWINSHADE_JOIN(a, b) TWINSHADE_JOIN_(a, b)

// The build defines TWINSHADE_ISA for objects made by twinshade_isa_objects. Elsewhere (no instruction set flags given)
// the runtime falls back to what the compiler's default target has, in a namespace of its own.
#if defined(TWINSHADE_ISA)
#define TWINSHADE_ISA_NAMESPACE TWINSHADE_JOIN(isa_, TWINSHADE_ISA)
#define TWINSHADE_ISA_NUMBER TWINSHADE_JOIN(TWINSHADE_ISA_NUMBER_, TWINSHADE_ISA)
#else
#define TWINSHADE_ISA_NAMESPACE isa_of_compiler_default
#define TWINSHADE_ISA_NUMBER 0
#endif
// As enum Isa of shader_abi.h, for #if.
#define TWINSHADE_ISA_NUMBER_baseline 0
#define TWINSHADE_ISA_NUMBER_avx2 1
#define TWINSHADE_ISA_NUMBER_avx512 2

// A shader is one function made of thousands of small ones: past some size compilers stop inlining unless told.
#define TWINSHADE_INLINE __attribute__((always_inline)) inline
#define TWINSHADE_LAMBDA __attribute__((always_inline))  // after a lambda's parameters
// Functions of the shader's own, and larger ones of the runtime. g++ optimises an always-inline function by itself
// before it is inlined, with all that is inlined into it: main, what main calls and so on, each with the whole shader's
// code. So they are plain functions to it, and all calls of TWINSHADE_WHOLE functions are inlined at once; what is to
// stay a function is TWINSHADE_APART.
#if defined(__clang__)
#define TWINSHADE_FUNCTION TWINSHADE_INLINE
#define TWINSHADE_WHOLE
#define TWINSHADE_APART __attribute__((noinline))
#else
#define TWINSHADE_FUNCTION inline
#define TWINSHADE_WHOLE __attribute__((flatten))
#define TWINSHADE_APART __attribute__((noinline)) TWINSHADE_WHOLE
#endif

namespace twinshade {
inline namespace TWINSHADE_ISA_NAMESPACE {

// 32-bit lanes in one register. Wider values are pairs of halves.
#if defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX512VL__) && defined(__AVX512BW__)
inline constexpr int kNativeLanes = 16;
#elif defined(__AVX2__)
inline constexpr int kNativeLanes = 8;
#else
inline constexpr int kNativeLanes = 4;
#endif

}  // namespace TWINSHADE_ISA_NAMESPACE
}  // namespace twinshade
