// Value and bit conversions of scalars and vectors. Out-of-range values clamp, NaN becomes 0.
#pragma once

#include "cpu_shaders/runtime/aggregates.h"

namespace twinshade {
inline namespace TWINSHADE_ISA_NAMESPACE {

// To the real type of policy N: an integer alone does not tell float from double.
template <class N, LaneOrVec A>
TWINSHADE_INLINE constexpr auto to_float(const A& a) {
  return map([](const auto& x) TWINSHADE_LAMBDA { return x.template to<typename N::real>(); }, a);
}
template <LaneOrVec A>
TWINSHADE_INLINE constexpr auto to_int(const A& a) {
  return map([](const auto& x) TWINSHADE_LAMBDA { return x.template to<std::int32_t>(); }, a);
}
template <LaneOrVec A>
TWINSHADE_INLINE constexpr auto to_uint(const A& a) {
  return map([](const auto& x) TWINSHADE_LAMBDA { return x.template to<std::uint32_t>(); }, a);
}
template <LaneOrVec A>
TWINSHADE_INLINE constexpr auto to_bool(const A& a) {
  return map([](const auto& x) TWINSHADE_LAMBDA { return x.template to<bool>(); }, a);
}

// The same bits: policies of 32-bit floats only.
template <LaneOrVec A>
TWINSHADE_INLINE auto float_as_int(const A& a) {
  return map([](const auto& x) TWINSHADE_LAMBDA { return x.template as<std::int32_t>(); }, a);
}
template <LaneOrVec A>
TWINSHADE_INLINE auto float_as_uint(const A& a) {
  return map([](const auto& x) TWINSHADE_LAMBDA { return x.template as<std::uint32_t>(); }, a);
}
template <LaneOrVec A>
TWINSHADE_INLINE auto int_as_float(const A& a) {
  return map([](const auto& x) TWINSHADE_LAMBDA { return x.template as<float>(); }, a);
}
template <LaneOrVec A>
TWINSHADE_INLINE auto uint_as_float(const A& a) {
  return map([](const auto& x) TWINSHADE_LAMBDA { return x.template as<float>(); }, a);
}

}  // namespace TWINSHADE_ISA_NAMESPACE
}  // namespace twinshade
