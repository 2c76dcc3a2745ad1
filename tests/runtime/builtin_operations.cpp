// GLSL built-ins of one number, and packing.
#include "tests/runtime/operations_by_policy.h"

namespace twinshade {
inline namespace TWINSHADE_ISA_NAMESPACE {
namespace {

template <class N>
struct Group {
  static constexpr Operation list[] = {
      OPERATION("sign(a)", return glsl::sign(a);),
      OPERATION("sign(i)", return glsl::sign(i);),
      OPERATION("fract(a)", return glsl::fract(a);),
      OPERATION("mod(a, b)", return glsl::mod(a, b);),
      OPERATION("clamp(a, b, c)", return glsl::clamp(a, b, c);),
      OPERATION("clamp(i, j, k)", return glsl::clamp(i, j, k);),
      OPERATION("mix(a, b, c)", return glsl::mix(a, b, c);),
      OPERATION("mix(a, b, bool(i & 1))", return glsl::mix(a, b, to_bool(i& UI(1)));),
      OPERATION("step(a, b)", return glsl::step(a, b);),
      OPERATION("smoothstep(a, b, c)", return glsl::smoothstep(a, b, c);),
      OPERATION("isnan(a)", return glsl::isnan(a);),
      OPERATION("isinf(a)", return glsl::isinf(a);),
      OPERATION("fma(a, b, c)", return glsl::fma(a, b, c);),
      OPERATION("inversesqrt(a)", return glsl::inversesqrt(a);),
      OPERATION("modf(a)", F whole; const F part = glsl::modf(a, whole); return vec<F, 2>(part, whole);),
      OPERATION("frexp(a)", I e; return glsl::frexp(a, e);),
      OPERATION("frexp(a) exponent", I e; (void)glsl::frexp(a, e); return e;),
      OPERATION("ldexp(a, j)", return glsl::ldexp(a, j);),
      OPERATION("ldexp(a, (j & 511) - 256)", return glsl::ldexp(a, (j & UI(511)) - UI(256));),
      OPERATION("bitfieldExtract(i, j & 31, k % 17)",
                return glsl::bitfieldExtract(i, j& UI(15), (r % UU(17u)).template to<std::int32_t>());),
      OPERATION("bitfieldExtract(p, j & 31, k % 17)",
                return glsl::bitfieldExtract(p, j& UI(15), (r % UU(17u)).template to<std::int32_t>());),
      OPERATION("bitfieldInsert(p, q, r & 15, 16)", return glsl::bitfieldInsert(p, q, k& UI(15), UI(16));),
      OPERATION("bitfieldInsert(i, j, 0, 32)", return glsl::bitfieldInsert(i, j, UI(0), UI(32));),
      OPERATION("bitfieldReverse(p)", return glsl::bitfieldReverse(p);),
      OPERATION("bitCount(p)", return glsl::bitCount(p);),
      OPERATION("findLSB(i)", return glsl::findLSB(i);),
      OPERATION("findMSB(i)", return glsl::findMSB(i);),
      OPERATION("findMSB(p)", return glsl::findMSB(p);),
      OPERATION("uaddCarry(p, q)", U carry; const U sum = glsl::uaddCarry(p, q, carry); return vec<U, 2>(sum, carry);),
      OPERATION("usubBorrow(p, q)", U borrow; const U d = glsl::usubBorrow(p, q, borrow); return vec<U, 2>(d, borrow);),
      OPERATION("umulExtended(p, q)", U high; U low; glsl::umulExtended(p, q, high, low); return vec<U, 2>(high, low);),
      OPERATION("imulExtended(i, j)", I high; I low; glsl::imulExtended(i, j, high, low); return vec<I, 2>(high, low);),
      OPERATION("packUnorm2x16(a, b)", return glsl::packUnorm2x16(vec<F, 2>(a, b));),
      OPERATION("packSnorm2x16(a, b)", return glsl::packSnorm2x16(vec<F, 2>(a, b));),
      OPERATION("packUnorm4x8(a, b, c, a)", return glsl::packUnorm4x8(vec<F, 4>(a, b, c, a));),
      OPERATION("packSnorm4x8(a, b, c, a)", return glsl::packSnorm4x8(vec<F, 4>(a, b, c, a));),
      OPERATION("packHalf2x16(a, b)", return glsl::packHalf2x16(vec<F, 2>(a, b));),
      OPERATION("unpackUnorm2x16(p)", return glsl::unpackUnorm2x16<N>(p);),
      OPERATION("unpackSnorm2x16(p)", return glsl::unpackSnorm2x16<N>(p);),
      OPERATION("unpackUnorm4x8(p)", return glsl::unpackUnorm4x8<N>(p);),
      OPERATION("unpackSnorm4x8(p)", return glsl::unpackSnorm4x8<N>(p);),
      OPERATION("unpackHalf2x16(p)", return glsl::unpackHalf2x16<N>(p);),
      OPERATION("radians(a)", return glsl::radians(a);),
      OPERATION("degrees(a)", return glsl::degrees(a);),
      OPERATION("sin(a)", return glsl::sin(a);),
      OPERATION("cos(a)", return glsl::cos(a);),
      OPERATION("tan(a)", return glsl::tan(a);),
      OPERATION("asin(a)", return glsl::asin(a);),
      OPERATION("acos(a)", return glsl::acos(a);),
      OPERATION("atan(a)", return glsl::atan(a);),
      OPERATION("atan(a, b)", return glsl::atan(a, b);),
      OPERATION("sinh(a)", return glsl::sinh(a);),
      OPERATION("cosh(a)", return glsl::cosh(a);),
      OPERATION("tanh(a)", return glsl::tanh(a);),
      OPERATION("asinh(a)", return glsl::asinh(a);),
      OPERATION("acosh(a)", return glsl::acosh(a);),
      OPERATION("atanh(a)", return glsl::atanh(a);),
      OPERATION("exp(a)", return glsl::exp(a);),
      OPERATION("exp2(a)", return glsl::exp2(a);),
      OPERATION("log(a)", return glsl::log(a);),
      OPERATION("log2(a)", return glsl::log2(a);),
      OPERATION("pow(a, b)", return glsl::pow(a, b);),
      OPERATION("pow(a, 2 uniform)", return glsl::pow(a, UF(2.0f));),
  };
};

OPERATION_SETS(builtin)

}  // namespace
}  // namespace TWINSHADE_ISA_NAMESPACE
}  // namespace twinshade
