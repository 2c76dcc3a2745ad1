// Number policies: what a shader is generic in. docs/generated-code.md has the table.
#pragma once

#include "cpu_shaders/runtime/simd_lanes.h"

namespace twinshade {
inline namespace TWINSHADE_ISA_NAMESPACE {

// texture.h
template <class Real>
struct Sampler2D;
template <class Real>
struct Sampler2DArray;
template <class Real>
struct SamplerCube;

// SPMD: W invocations at once, float.
template <int W>
struct Lanes {
  using real = float;
  static constexpr int width = W;
  static constexpr bool is_exact_float = true;
  using F = Simd<float, W>;
  using I = Simd<std::int32_t, W>;
  using U = Simd<std::uint32_t, W>;
  using B = SimdMask<W>;
  using UF = Plain<float, 1>;
  using UI = Plain<std::int32_t, 1>;
  using UU = Plain<std::uint32_t, 1>;
  using UB = Plain<bool, 1>;
  using sampler2D = Sampler2D<real>;
  using sampler2DArray = Sampler2DArray<real>;
  using samplerCube = SamplerCube<real>;
};

template <class N>
inline constexpr bool is_simd = false;
template <int W>
inline constexpr bool is_simd<Lanes<W>> = true;

// One invocation (W = 1), or one quad (W = 4) for shaders that use derivatives, a lane at a time.
template <class Real, int W>
struct Steps {
  using real = Real;
  static constexpr int width = W;
  static constexpr bool is_exact_float = std::same_as<Real, float>;
  using F = Plain<Real, W>;
  using I = Plain<std::int32_t, W>;
  using U = Plain<std::uint32_t, W>;
  using B = Plain<bool, W>;
  using UF = Plain<Real, 1>;
  using UI = Plain<std::int32_t, 1>;
  using UU = Plain<std::uint32_t, 1>;
  using UB = Plain<bool, 1>;
  using sampler2D = Sampler2D<real>;
  using sampler2DArray = Sampler2DArray<real>;
  using samplerCube = SamplerCube<real>;
};
using Scalar32 = Steps<float, 1>;
using Scalar64 = Steps<double, 1>;
using Quad32 = Steps<float, 4>;
using Quad64 = Steps<double, 4>;

// A uniform constant, written in generated code as a hexadecimal float; Scalar64 widens the float value.
template <class N>
TWINSHADE_INLINE constexpr typename N::UF constant(float x) {
  return typename N::UF(static_cast<typename N::real>(x));
}

}  // namespace TWINSHADE_ISA_NAMESPACE
}  // namespace twinshade
