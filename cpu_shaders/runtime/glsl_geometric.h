// GLSL 4.50 sections 8.5 and 8.6: geometric and matrix functions, and the operators of matrices. Sums in Mesa's order:
// dot of three or four is summed from the last component ((w + z) + y) + x, of two from the first; matrix times vector
// is a sum of columns from the first; vector times matrix is a dot per column.
#pragma once

#include "cpu_shaders/runtime/glsl_common.h"

namespace twinshade {
inline namespace TWINSHADE_ISA_NAMESPACE {
namespace glsl {

template <LaneOrVec A, LaneOrVec B>
TWINSHADE_INLINE auto dot(const A& a, const B& b) {
  if constexpr (Lane<A>) {
    return a * b;
  } else {
    const auto p = a * b;
    if constexpr (A::size == 2)
      return p.x + p.y;
    else if constexpr (A::size == 3)
      return (p.z + p.y) + p.x;
    else
      return ((p.w + p.z) + p.y) + p.x;
  }
}
template <LaneOrVec A>
TWINSHADE_INLINE auto sqrt(const A& a) {
  return map([](const auto& x) TWINSHADE_LAMBDA { return lanes_sqrt(x); }, a);
}
template <LaneOrVec A>
TWINSHADE_INLINE auto inversesqrt(const A& a) {
  return map([](const auto& x) TWINSHADE_LAMBDA { return detail::constant_for(x, 1) / lanes_sqrt(x); }, a);
}
template <LaneOrVec A>
TWINSHADE_INLINE auto length(const A& a) {
  if constexpr (Lane<A>)
    return lanes_abs(a);
  else
    return lanes_sqrt(dot(a, a));
}
template <LaneOrVec A, LaneOrVec B>
TWINSHADE_INLINE auto distance(const A& a, const B& b) {
  return length(a - b);
}
template <LaneOrVec A>
TWINSHADE_INLINE auto normalize(const A& a) {
  if constexpr (Lane<A>)
    return sign(a);
  else
    return a * inversesqrt(dot(a, a));
}
template <Vec A, Vec B>
TWINSHADE_INLINE auto cross(const A& a, const B& b) {
  return swizzle<1, 2, 0>(a) * swizzle<2, 0, 1>(b) - swizzle<2, 0, 1>(a) * swizzle<1, 2, 0>(b);
}
template <LaneOrVec N, LaneOrVec I, LaneOrVec R>
TWINSHADE_INLINE auto faceforward(const N& normal, const I& incident, const R& reference) {
  const auto d = dot(reference, incident);
  return select(d < detail::constant_for(d, 0), normal, -normal);
}
template <LaneOrVec I, LaneOrVec N>
TWINSHADE_INLINE auto reflect(const I& incident, const N& normal) {
  const auto d = dot(normal, incident);
  return incident - detail::constant_for(d, 2) * (d * normal);
}
template <LaneOrVec I, LaneOrVec N, Lane E>
TWINSHADE_INLINE auto refract(const I& incident, const N& normal, const E& eta) {
  const auto d = dot(normal, incident);
  const auto zero = detail::constant_for(d, 0), one = detail::constant_for(d, 1);
  const auto k = one - eta * (eta * (one - d * d));
  const auto bent = eta * incident - (eta * d + lanes_sqrt(k)) * normal;
  return map([&](const auto& x) TWINSHADE_LAMBDA { return select(k < zero, zero, x); }, bent);
}

}  // namespace glsl

// --- operators of matrices

namespace detail {
// f(column of a, column of b) for each column; a scalar stands for every column.
template <class F, class A, class B>
TWINSHADE_INLINE auto map_columns(F f, const A& a, const B& b) {
  const auto column = [](const auto& m, int i) TWINSHADE_LAMBDA -> const auto& {
    if constexpr (Mat<std::remove_cvref_t<decltype(m)>>)
      return m.c[i];
    else
      return m;
  };
  using M = std::conditional_t<Mat<A>, A, B>;
  using C = decltype(f(column(a, 0), column(b, 0)));
  mat<typename C::element, M::column_count, M::row_count> r;
  for (int i = 0; i < M::column_count; ++i) r.c[i] = f(column(a, i), column(b, i));
  return r;
}
}  // namespace detail

// clang-format off
#define TWINSHADE_MAT_OPERATOR(op)                                                              \
  template <class A, class B>                                                                   \
    requires((Mat<A> && (Mat<B> || Lane<B>)) || (Lane<A> && Mat<B>))                            \
  TWINSHADE_INLINE auto operator op(const A& a, const B& b) {                                   \
    return detail::map_columns([](const auto& x, const auto& y) TWINSHADE_LAMBDA { return x op y; }, a, b);      \
  }
TWINSHADE_MAT_OPERATOR(+)
TWINSHADE_MAT_OPERATOR(-)
TWINSHADE_MAT_OPERATOR(/)
#undef TWINSHADE_MAT_OPERATOR
// clang-format on
template <class A, class B>
requires((Mat<A> && Lane<B>) || (Lane<A> && Mat<B>)) TWINSHADE_INLINE auto operator*(const A& a, const B& b) {
  return detail::map_columns([](const auto& x, const auto& y) TWINSHADE_LAMBDA { return x * y; }, a, b);
}
template <Mat A>
TWINSHADE_INLINE auto operator-(const A& a) {
  A r;
  for (int i = 0; i < A::column_count; ++i) r.c[i] = -a.c[i];
  return r;
}
template <Mat M, Vec V>
TWINSHADE_INLINE auto operator*(const M& m, const V& v) {
  auto sum = m.c[0] * v.x;
  if constexpr (M::column_count > 1) sum = sum + m.c[1] * v.y;
  if constexpr (M::column_count > 2) sum = sum + m.c[2] * v.z;
  if constexpr (M::column_count > 3) sum = sum + m.c[3] * v.w;
  return sum;
}
template <Vec V, Mat M>
TWINSHADE_INLINE auto operator*(const V& v, const M& m) {
  return [&]<int... k>(std::integer_sequence<int, k...>) TWINSHADE_LAMBDA {
    return vec<decltype(glsl::dot(v, m.c[0])), M::column_count>(glsl::dot(v, m.c[k])...);
  }
  (detail::Indices<M::column_count>());
}
template <Mat A, Mat B>
TWINSHADE_INLINE auto operator*(const A& a, const B& b) {
  using C = decltype(a * b.c[0]);
  mat<typename C::element, B::column_count, A::row_count> r;
  for (int i = 0; i < B::column_count; ++i) r.c[i] = a * b.c[i];
  return r;
}

namespace glsl {

template <Mat A, Mat B>
TWINSHADE_INLINE auto matrixCompMult(const A& a, const B& b) {
  return detail::map_columns([](const auto& x, const auto& y) TWINSHADE_LAMBDA { return x * y; }, a, b);
}
template <Vec C, Vec R>
TWINSHADE_INLINE auto outerProduct(const C& column, const R& row) {
  return [&]<int... k>(std::integer_sequence<int, k...>) TWINSHADE_LAMBDA {
    using T = typename decltype(column * row.x)::element;
    return mat<T, R::size, C::size>(column * row.template at<k>()...);
  }
  (detail::Indices<R::size>());
}
template <Mat M>
TWINSHADE_INLINE auto transpose(const M& m) {
  mat<typename M::element, M::row_count, M::column_count> r;
  for (int c = 0; c < M::column_count; ++c) {
    for (int k = 0; k < M::row_count; ++k) r.c[k][c] = m.c[c][k];
  }
  return r;
}

namespace matrix {
// Determinant of the matrix without column c and row r (Laplace expansion along the first column left).
template <Mat M>
TWINSHADE_INLINE auto minor(const M& m, int c, int r);
}  // namespace matrix

template <Mat M>
TWINSHADE_INLINE auto determinant(const M& m) {
  if constexpr (M::column_count == 2) {
    return m.c[0].x * m.c[1].y - m.c[1].x * m.c[0].y;
  } else {
    auto sum = m.c[0].x * matrix::minor(m, 0, 0) - m.c[0].y * matrix::minor(m, 0, 1);
    sum = sum + m.c[0].z * matrix::minor(m, 0, 2);
    if constexpr (M::column_count > 3) sum = sum - m.c[0].w * matrix::minor(m, 0, 3);
    return sum;
  }
}
// Adjugate over determinant.
template <Mat M>
TWINSHADE_INLINE M inverse(const M& m) {
  constexpr int n = M::column_count;
  M adjugate;
  for (int c = 0; c < n; ++c) {
    for (int r = 0; r < n; ++r) {
      if constexpr (n == 2) {
        const auto& x = m.c[1 - r][1 - c];
        adjugate.c[c][r] = (c + r) % 2 ? -x : x;
      } else {
        const auto x = matrix::minor(m, r, c);
        adjugate.c[c][r] = (c + r) % 2 ? -x : x;
      }
    }
  }
  return adjugate / determinant(m);
}

template <Mat M>
TWINSHADE_INLINE auto matrix::minor(const M& m, int c, int r) {
  constexpr int n = M::column_count - 1;
  mat<typename M::element, n, n> rest;
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < n; ++k) rest.c[i][k] = m.c[i + (i >= c)][k + (k >= r)];
  }
  return determinant(rest);
}

}  // namespace glsl
}  // namespace TWINSHADE_ISA_NAMESPACE
}  // namespace twinshade
