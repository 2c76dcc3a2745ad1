// Equivalents of functions of shaders/exact/.
//
// Scalar64: the transcendentals, in double. Their GLSL bodies are float polynomials over bit casts: in double they
// would measure the polynomial's error instead of the rounding's.
//
// Lanes: the written-out bilinear filters, in served_fetch.h; those of all layers' colours, in served_fetch_colors.h,
// for every policy.
#pragma once

#include "base/portable_math.h"
#include "cpu_shaders/runtime/served_fetch_colors.h"

namespace twinshade {
inline namespace TWINSHADE_ISA_NAMESPACE {
namespace served {

template <class N>
inline constexpr bool is_double = !N::is_exact_float;

// clang-format off
#define TWINSHADE_SERVED_DOUBLE(name, function)                                                                    \
  template <class N>                                                                                               \
  inline constexpr bool has_##name = is_double<N>;                                                                 \
  template <class N, class... A>                                                                                   \
  TWINSHADE_INLINE typename N::F name(const A&... a) {                                                             \
    return map_lanes([](auto... x) TWINSHADE_LAMBDA { return function(x...); }, typename N::F(a)...);                               \
  }
TWINSHADE_SERVED_DOUBLE(exact_exp2, portable::exp2)
TWINSHADE_SERVED_DOUBLE(exact_log2, portable::log2)
TWINSHADE_SERVED_DOUBLE(exact_pow, portable::pow)
TWINSHADE_SERVED_DOUBLE(exact_sin, portable::sin)
TWINSHADE_SERVED_DOUBLE(exact_cos, portable::cos)
TWINSHADE_SERVED_DOUBLE(exact_atan2, portable::atan2)
TWINSHADE_SERVED_DOUBLE(exact_acos, portable::acos)
TWINSHADE_SERVED_DOUBLE(exact_asin, portable::asin)
#undef TWINSHADE_SERVED_DOUBLE
// clang-format on

}  // namespace served
}  // namespace TWINSHADE_ISA_NAMESPACE
}  // namespace twinshade
