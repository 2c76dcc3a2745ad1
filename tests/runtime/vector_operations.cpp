// Vectors and matrices: operators, swizzles, geometric and matrix functions, vector relations.
#include "tests/runtime/operations_by_policy.h"

namespace twinshade {
inline namespace TWINSHADE_ISA_NAMESPACE {
namespace {

// A number that the compiler does not know: x * 1 is x to some, denormal or not, and a multiplication to others.
TWINSHADE_INLINE float unknown(float x) {
  __asm__ volatile("" : "+m"(x));
  return x;
}

// Vectors and matrices made of a, b and c.
template <class N>
struct Made {
  using F = typename N::F;
  using UF = typename N::UF;
  using real = typename N::real;
  vec<F, 2> v2, w2;
  vec<F, 3> v, w;
  vec<F, 4> v4, w4;
  mat<F, 2, 2> m2;
  mat<F, 3, 3> m;
  mat<F, 4, 4> m4;
  mat<F, 2, 3> m23;
  vec<UF, 3> u;
  TWINSHADE_INLINE Made(F a, F b, F c)
      : v2(a, b),
        w2(c, a),
        v(a, b, c),
        w(b, c, a),
        v4(v, b),
        w4(c, w),
        m2(v2, w2),
        m(v, w, vec<F, 3>(b, a, c)),
        m4(v4, w4, vec<F, 4>(b, a, c, a), vec<F, 4>(c, c, b, a)),
        m23(v, w),
        u(UF(real(unknown(1.0f))), UF(real(unknown(-2.0f))), UF(real(unknown(0.5f)))) {}
};
#define ON_VECTORS(name, ...) OPERATION(name, [[maybe_unused]] const Made<N> s(a, b, c); return __VA_ARGS__;)

template <class N>
struct Group {
  static constexpr Operation list[] = {
      ON_VECTORS("v + w", s.v + s.w),
      ON_VECTORS("v - u", s.v - s.u),
      ON_VECTORS("u * v", s.u* s.v),
      ON_VECTORS("v / a", s.v / a),
      ON_VECTORS("2 / v", UF(2.0f) / s.v),
      ON_VECTORS("-v4", -s.v4),
      ON_VECTORS("v.zxy", swizzle<2, 0, 1>(s.v)),
      ON_VECTORS("v == w", s.v == s.w),
      ON_VECTORS("v != u", s.v != s.u),
      ON_VECTORS("dot(v2, w2)", glsl::dot(s.v2, s.w2)),
      ON_VECTORS("dot(v, w)", glsl::dot(s.v, s.w)),
      ON_VECTORS("dot(v4, w4)", glsl::dot(s.v4, s.w4)),
      ON_VECTORS("length(v)", glsl::length(s.v)),
      ON_VECTORS("distance(v, w)", glsl::distance(s.v, s.w)),
      ON_VECTORS("normalize(v)", glsl::normalize(s.v)),
      ON_VECTORS("cross(v, w)", glsl::cross(s.v, s.w)),
      ON_VECTORS("faceforward(v, w, u)", glsl::faceforward(s.v, s.w, s.u)),
      ON_VECTORS("reflect(v, w)", glsl::reflect(s.v, s.w)),
      ON_VECTORS("refract(v, w, a)", glsl::refract(s.v, s.w, a)),
      ON_VECTORS("m * v", s.m* s.v),
      ON_VECTORS("v * m", s.v* s.m),
      ON_VECTORS("m * m", s.m* s.m),
      ON_VECTORS("m23 * v2", s.m23* s.v2),
      ON_VECTORS("v * m23", s.v* s.m23),
      ON_VECTORS("m4 * v4", s.m4* s.v4),
      ON_VECTORS("m + m * 2 - m / a", s.m + s.m * UF(2.0f) - s.m / a),
      ON_VECTORS("matrixCompMult(m, m)", glsl::matrixCompMult(s.m, s.m)),
      ON_VECTORS("outerProduct(v, w2)", glsl::outerProduct(s.v, s.w2)),
      ON_VECTORS("transpose(m23)", glsl::transpose(s.m23)),
      ON_VECTORS("determinant(m2)", glsl::determinant(s.m2)),
      ON_VECTORS("determinant(m)", glsl::determinant(s.m)),
      ON_VECTORS("determinant(m4)", glsl::determinant(s.m4)),
      ON_VECTORS("inverse(m2)", glsl::inverse(s.m2)),
      ON_VECTORS("inverse(m)", glsl::inverse(s.m)),
      ON_VECTORS("inverse(m4)", glsl::inverse(s.m4)),
      ON_VECTORS("lessThan(v, w)", glsl::lessThan(s.v, s.w)),
      ON_VECTORS("any(equal(v, w))", glsl::any(glsl::equal(s.v, s.w))),
      ON_VECTORS("all(greaterThanEqual(v, w))", glsl::all(glsl::greaterThanEqual(s.v, s.w))),
      ON_VECTORS("not(notEqual(v, u))", glsl::not_(glsl::notEqual(s.v, s.u))),
      ON_VECTORS("select(lessThan(v, w), v, u)", select(glsl::lessThan(s.v, s.w), s.v, s.u)),
      ON_VECTORS("select(a < b, m, transpose(m))", select(a < b, s.m, glsl::transpose(s.m))),
      ON_VECTORS("clamp(v, 0, 1)", glsl::clamp(s.v, UF(0.0f), UF(1.0f))),
      ON_VECTORS("mix(v, w, a)", glsl::mix(s.v, s.w, a)),
      ON_VECTORS("ivec3(v) << 2", vec<I, 3>(s.v) << UI(2)),
  };
};

OPERATION_SETS(vector)

}  // namespace
}  // namespace TWINSHADE_ISA_NAMESPACE
}  // namespace twinshade
