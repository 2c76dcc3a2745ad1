// vec, mat and arr over lane types, with GLSL's operators, mixing uniform and varying elements: whatever a varying
// operand touches is varying.
#pragma once

#include <array>
#include <tuple>

#include "cpu_shaders/runtime/numbers.h"

namespace twinshade {
inline namespace TWINSHADE_ISA_NAMESPACE {

template <class T>
concept Lane = requires {
  T::is_lanes;
};

template <class T, int n>
struct vec;
template <class T, int columns, int rows>
struct mat;
template <class T, int n>
struct arr;

namespace detail {
template <class T>
struct Shape {
  static constexpr bool is_vec = false, is_mat = false, is_arr = false;
  static constexpr int count = 1;  // values in a constructor's argument
};
template <class T, int n>
struct Shape<vec<T, n>> {
  static constexpr bool is_vec = true, is_mat = false, is_arr = false;
  static constexpr int count = n;
};
template <class T, int c, int r>
struct Shape<mat<T, c, r>> {
  static constexpr bool is_vec = false, is_mat = true, is_arr = false;
  static constexpr int count = c * r;
};
template <class T, int n>
struct Shape<arr<T, n>> {
  static constexpr bool is_vec = false, is_mat = false, is_arr = true;
  static constexpr int count = n;
};
}  // namespace detail

template <class T>
concept Vec = detail::Shape<T>::is_vec;
template <class T>
concept Mat = detail::Shape<T>::is_mat;
template <class T>
concept Arr = detail::Shape<T>::is_arr;
template <class T>
concept LaneOrVec = Lane<T> || Vec<T>;

// --- vec<T, n>: n components

template <class T, int n>
struct vec {
  using element = T;
  static constexpr int size = n;

  T e[n];

  vec() = default;
  TWINSHADE_INLINE constexpr explicit vec(const T& x) : e{} {  // the same in every component
    for (int i = 0; i < n; ++i) e[i] = x;
  }
  // From scalars and vectors, n components altogether.
  template <LaneOrVec... A>
  requires(sizeof...(A) > 1 && (detail::Shape<A>::count + ...) == n) TWINSHADE_INLINE constexpr vec(const A&... parts)
      : e{} {
    int at = 0;
    (append(at, parts), ...);
  }
  template <class G>
  requires(!std::same_as<G, T> && std::convertible_to<G, T>) TWINSHADE_INLINE constexpr vec(const vec<G, n>& v)
      : e{} {  // uniform to varying
    for (int i = 0; i < n; ++i) e[i] = v.e[i];
  }
  template <class G>
  requires(!std::convertible_to<G, T> && std::constructible_from<T, G>) TWINSHADE_INLINE
      constexpr explicit vec(const vec<G, n>& v)
      : e{} {  // value conversion
    for (int i = 0; i < n; ++i) e[i] = T(v.e[i]);
  }

  TWINSHADE_INLINE constexpr T& operator[](int i) { return e[i]; }
  TWINSHADE_INLINE constexpr const T& operator[](int i) const { return e[i]; }
  template <int i>
  TWINSHADE_INLINE constexpr T& at() {
    static_assert(i >= 0 && i < n);
    return e[i];
  }
  template <int i>
  TWINSHADE_INLINE constexpr const T& at() const {
    static_assert(i >= 0 && i < n);
    return e[i];
  }

 private:
  template <class A>
  TWINSHADE_INLINE constexpr void append(int& at, const A& part) {
    if constexpr (Vec<A>) {
      for (int i = 0; i < A::size; ++i) e[at++] = part.e[i];
    } else {
      e[at++] = part;
    }
  }
};

// --- mat<T, columns, rows>: column-major, m[c] is a column

template <class T, int columns, int rows>
struct mat {
  using element = T;
  using column = vec<T, rows>;
  static constexpr int column_count = columns, row_count = rows;

  column c[columns];

  mat() = default;
  template <Vec... A>
  requires(sizeof...(A) == columns && (std::convertible_to<A, column> && ...)) TWINSHADE_INLINE
      constexpr mat(const A&... parts)
      : c{column(parts)...} {}
  template <Lane... A>
  requires(sizeof...(A) == columns * rows && (std::convertible_to<A, T> && ...)) TWINSHADE_INLINE
      constexpr mat(const A&... parts)
      : c{} {
    int at = 0;
    ((c[at / rows].e[at % rows] = parts, ++at), ...);
  }
  template <class G>
  requires(!std::same_as<G, T> && std::convertible_to<G, T>) TWINSHADE_INLINE
      constexpr mat(const mat<G, columns, rows>& m)
      : c{} {
    for (int i = 0; i < columns; ++i) c[i] = m.c[i];
  }

  TWINSHADE_INLINE constexpr column& operator[](int i) { return c[i]; }
  TWINSHADE_INLINE constexpr const column& operator[](int i) const { return c[i]; }
};

// --- arr<T, n>: n of anything, structs and arrays included

template <class T, int n>
struct arr {
  using element = T;
  static constexpr int size = n;

  T e[n];

  arr() = default;
  template <class... A>
  requires(sizeof...(A) == n && (std::convertible_to<A, T> && ...)) TWINSHADE_INLINE constexpr arr(const A&... parts)
      : e{static_cast<T>(parts)...} {}
  template <class G>
  requires(!std::same_as<G, T> && std::convertible_to<G, T>) TWINSHADE_INLINE constexpr arr(const arr<G, n>& a) : e{} {
    for (int i = 0; i < n; ++i) e[i] = a.e[i];
  }

  TWINSHADE_INLINE constexpr T& operator[](int i) { return e[i]; }
  TWINSHADE_INLINE constexpr const T& operator[](int i) const { return e[i]; }
};

// --- component-wise application: scalars stand for every component

namespace detail {
template <class A>
TWINSHADE_INLINE constexpr const auto& component(const A& a, int i) {
  if constexpr (Vec<A>)
    return a.e[i];
  else
    return a;
}
template <class... A>
constexpr int vec_size() {
  int size = 0;
  ((size = Vec<A> ? Shape<A>::count : size), ...);
  return size;
}
}  // namespace detail

template <class F, class... A>
TWINSHADE_INLINE constexpr auto map(F f, const A&... a) {
  constexpr int n = detail::vec_size<A...>();
  if constexpr (n == 0) {
    return f(a...);
  } else {
    using R = decltype(f(detail::component(a, 0)...));
    vec<R, n> r{};
    for (int i = 0; i < n; ++i) r.e[i] = f(detail::component(a, i)...);
    return r;
  }
}

// clang-format off
#define TWINSHADE_VEC_OPERATOR(op)                                                                    \
  template <LaneOrVec A, LaneOrVec B>                                                                 \
    requires(Vec<A> || Vec<B>)                                                                        \
  TWINSHADE_INLINE constexpr auto operator op(const A& a, const B& b) {                               \
    return map([](const auto& x, const auto& y) { return x op y; }, a, b);                            \
  }                                                                                                   \
  template <Vec A, LaneOrVec B>                                                                       \
  TWINSHADE_INLINE constexpr A& operator op##=(A& a, const B& b) { return a = a op b; }               \
  template <Lane A, Lane B>                                                                           \
  TWINSHADE_INLINE constexpr A& operator op##=(A& a, const B& b) { return a = a op b; }
TWINSHADE_VEC_OPERATOR(+)
TWINSHADE_VEC_OPERATOR(-)
TWINSHADE_VEC_OPERATOR(*)
TWINSHADE_VEC_OPERATOR(/)
TWINSHADE_VEC_OPERATOR(%)
TWINSHADE_VEC_OPERATOR(&)
TWINSHADE_VEC_OPERATOR(|)
TWINSHADE_VEC_OPERATOR(^)
TWINSHADE_VEC_OPERATOR(<<)
TWINSHADE_VEC_OPERATOR(>>)
#undef TWINSHADE_VEC_OPERATOR
// clang-format on

template <Vec A>
TWINSHADE_INLINE constexpr auto operator-(const A& a) {
  return map([](const auto& x) { return -x; }, a);
}
template <Vec A>
TWINSHADE_INLINE constexpr auto operator~(const A& a) {
  return map([](const auto& x) { return ~x; }, a);
}
template <Vec A>
TWINSHADE_INLINE constexpr auto operator!(const A& a) {
  return map([](const auto& x) { return !x; }, a);
}

// GLSL's == on vectors, matrices and arrays: one bool for the whole.
template <Vec A, Vec B>
TWINSHADE_INLINE constexpr auto operator==(const A& a, const B& b) {
  auto r = a.e[0] == b.e[0];
  for (int i = 1; i < A::size; ++i) r = r & (a.e[i] == b.e[i]);
  return r;
}
template <Mat A, Mat B>
TWINSHADE_INLINE constexpr auto operator==(const A& a, const B& b) {
  auto r = a.c[0] == b.c[0];
  for (int i = 1; i < A::column_count; ++i) r = r & (a.c[i] == b.c[i]);
  return r;
}
template <Arr A, Arr B>
TWINSHADE_INLINE constexpr auto operator==(const A& a, const B& b) {
  auto r = a.e[0] == b.e[0];
  for (int i = 1; i < A::size; ++i) r = r & (a.e[i] == b.e[i]);
  return r;
}
template <class A, class B>
requires((Vec<A> && Vec<B>) || (Mat<A> && Mat<B>) || (Arr<A> && Arr<B>)) TWINSHADE_INLINE constexpr auto operator!=(
    const A& a, const B& b) {
  return !(a == b);
}

// --- swizzles: swizzle<0, 0, 2>(v) is v.xxz

template <int... k, Vec V>
TWINSHADE_INLINE constexpr auto swizzle(const V& v) {
  static_assert(((k >= 0 && k < V::size) && ...));
  if constexpr (sizeof...(k) == 1)
    return (v.e[k], ...);
  else
    return vec<typename V::element, sizeof...(k)>(v.e[k]...);
}

// --- masks

// Per lane mask ? a : b; select of lanes themselves is a friend of each lane type. Two uniform operands under a varying
// mask give varying. A vector of masks selects by component.
template <Lane M, class E>
requires(M::width != 1) TWINSHADE_INLINE constexpr auto select(const M& m, Plain<E, 1> a, Plain<E, 1> b) {
  using R = typename M::template with<E>;
  return select(m, R(a), R(b));
}
template <class M, Vec A, Vec B>
TWINSHADE_INLINE constexpr auto select(const M& m, const A& a, const B& b) {
  return map([](const auto& c, const auto& x, const auto& y) { return select(c, x, y); }, m, a, b);
}
template <Lane M, Mat A, Mat B>
TWINSHADE_INLINE constexpr auto select(const M& m, const A& a, const B& b) {
  using T = decltype(select(m, a.c[0].e[0], b.c[0].e[0]));
  mat<T, A::column_count, A::row_count> r{};
  for (int i = 0; i < A::column_count; ++i) r.c[i] = select(m, a.c[i], b.c[i]);
  return r;
}
template <Lane M, class A, class B, int n>
TWINSHADE_INLINE constexpr auto select(const M& m, const arr<A, n>& a, const arr<B, n>& b) {
  using T = decltype(select(m, a.e[0], b.e[0]));
  arr<T, n> r{};
  for (int i = 0; i < n; ++i) r.e[i] = select(m, a.e[i], b.e[i]);
  return r;
}

// target = mask ? value : target. Lanes outside the mask keep what they had.
template <Lane M, class T, class V>
TWINSHADE_INLINE constexpr void assign(const M& m, T& target, const V& value) {
  target = select(m, T(value), target);
}

}  // namespace TWINSHADE_ISA_NAMESPACE
}  // namespace twinshade
