// GLSL 4.50 section 8.13: derivatives on 2 x 2 quads, always fine (per row, per column), as llvmpipe has them for all
// of dFdx, dFdxFine and dFdxCoarse. Uniform arguments have none.
#pragma once

#include "cpu_shaders/runtime/glsl_common.h"

namespace twinshade {
inline namespace TWINSHADE_ISA_NAMESPACE {
namespace glsl {

template <LaneOrVec A>
TWINSHADE_INLINE auto dFdx(const A& a) {
  return map(
      [](const auto& x) TWINSHADE_LAMBDA {
        using T = std::remove_cvref_t<decltype(x)>;
        if constexpr (T::width == 1)
          return T(typename T::element(0));
        else
          return quad_dx(x);
      },
      a);
}
template <LaneOrVec A>
TWINSHADE_INLINE auto dFdy(const A& a) {
  return map(
      [](const auto& x) TWINSHADE_LAMBDA {
        using T = std::remove_cvref_t<decltype(x)>;
        if constexpr (T::width == 1)
          return T(typename T::element(0));
        else
          return quad_dy(x);
      },
      a);
}
template <LaneOrVec A>
TWINSHADE_INLINE auto fwidth(const A& a) {
  return abs(dFdx(a)) + abs(dFdy(a));
}

}  // namespace glsl
}  // namespace TWINSHADE_ISA_NAMESPACE
}  // namespace twinshade
