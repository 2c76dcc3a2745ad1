// vec, mat and arr over lane types, with GLSL's operators, mixing uniform and varying elements: whatever a varying
// operand touches is varying.
#pragma once

#include <utility>

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

// --- vec<T, n>: n components x y z w

namespace detail {
template <class T, int n>
struct Components;
template <class T>
concept OneLane = T::width == 1;

// Copied component by component: GCC takes copies of whole structs apart into halves of 16 bytes, which wait for the
// stores of whole registers that they are read back from. Zero lanes are no constant expression for the same reason:
// they would be cleared by `rep stos`, whose start costs more than a few registers' stores.
template <class T>
struct Components<T, 1> {
  T x;
  constexpr Components() requires OneLane<T> : x{} {}
  TWINSHADE_INLINE Components() : x{} {}
  TWINSHADE_INLINE constexpr explicit Components(const T& x_) : x(x_) {}
  TWINSHADE_INLINE constexpr Components(const Components& o) : x(o.x) {}
  TWINSHADE_INLINE constexpr Components& operator=(const Components& o) {
    x = o.x;
    return *this;
  }
};
template <class T>
struct Components<T, 2> {
  T x, y;
  constexpr Components() requires OneLane<T> : x{}, y{} {}
  TWINSHADE_INLINE Components() : x{}, y{} {}
  TWINSHADE_INLINE constexpr explicit Components(const T& x_, const T& y_) : x(x_), y(y_) {}
  TWINSHADE_INLINE constexpr Components(const Components& o) : x(o.x), y(o.y) {}
  TWINSHADE_INLINE constexpr Components& operator=(const Components& o) {
    x = o.x;
    y = o.y;
    return *this;
  }
};
template <class T>
struct Components<T, 3> {
  T x, y, z;
  constexpr Components() requires OneLane<T> : x{}, y{}, z{} {}
  TWINSHADE_INLINE Components() : x{}, y{}, z{} {}
  TWINSHADE_INLINE constexpr explicit Components(const T& x_, const T& y_, const T& z_) : x(x_), y(y_), z(z_) {}
  TWINSHADE_INLINE constexpr Components(const Components& o) : x(o.x), y(o.y), z(o.z) {}
  TWINSHADE_INLINE constexpr Components& operator=(const Components& o) {
    x = o.x;
    y = o.y;
    z = o.z;
    return *this;
  }
};
template <class T>
struct Components<T, 4> {
  T x, y, z, w;
  constexpr Components() requires OneLane<T> : x{}, y{}, z{}, w{} {}
  TWINSHADE_INLINE Components() : x{}, y{}, z{}, w{} {}
  TWINSHADE_INLINE constexpr explicit Components(const T& x_, const T& y_, const T& z_, const T& w_)
      : x(x_), y(y_), z(z_), w(w_) {}
  TWINSHADE_INLINE constexpr Components(const Components& o) : x(o.x), y(o.y), z(o.z), w(o.w) {}
  TWINSHADE_INLINE constexpr Components& operator=(const Components& o) {
    x = o.x;
    y = o.y;
    z = o.z;
    w = o.w;
    return *this;
  }
};

// The k-th value of a constructor's argument list, vectors taken apart.
template <int k, class First, class... Rest>
TWINSHADE_INLINE constexpr const auto& nth(const First& first, const Rest&... rest) {
  constexpr int count = Shape<First>::count;
  if constexpr (k >= count)
    return nth<k - count>(rest...);
  else if constexpr (Vec<First>)
    return first.template at<k>();
  else
    return first;
}
template <int k, class A>
TWINSHADE_INLINE constexpr const auto& component(const A& a) {  // a scalar stands for every component
  if constexpr (Vec<A>)
    return a.template at<k>();
  else
    return a;
}
template <int n>
using Indices = std::make_integer_sequence<int, n>;
}  // namespace detail

template <class T, int n>
struct vec : detail::Components<T, n> {
  using element = T;
  static constexpr int size = n;

  vec() = default;
  TWINSHADE_INLINE constexpr explicit vec(const T& value) : vec(Splat{}, value, detail::Indices<n>()) {}
  // From scalars and vectors, n components altogether.
  template <LaneOrVec... A>
  requires(sizeof...(A) > 1 && (detail::Shape<A>::count + ...) == n) TWINSHADE_INLINE constexpr vec(const A&... parts)
      : vec(Parts{}, detail::Indices<n>(), parts...) {}
  template <class G>
  requires(!std::same_as<G, T> && std::convertible_to<G, T>) TWINSHADE_INLINE
      constexpr vec(const vec<G, n>& v)  // uniform to varying
      : vec(Parts{}, detail::Indices<n>(), v) {}
  template <class G>
  requires(!std::convertible_to<G, T> && std::constructible_from<T, G>) TWINSHADE_INLINE
      constexpr explicit vec(const vec<G, n>& v)  // value conversion
      : vec(Parts{}, detail::Indices<n>(), v) {}

  // Constant index, or uniform index clamped into range.
  TWINSHADE_INLINE constexpr T& operator[](int i) { return pick(*this, i); }
  TWINSHADE_INLINE constexpr const T& operator[](int i) const { return pick(*this, i); }
  template <number::Integer E>
  TWINSHADE_INLINE constexpr T& operator[](Plain<E, 1> i) {
    return pick(*this, number::clamp_index(i.e[0], n));
  }
  template <number::Integer E>
  TWINSHADE_INLINE constexpr const T& operator[](Plain<E, 1> i) const {
    return pick(*this, number::clamp_index(i.e[0], n));
  }
  template <int i>
  TWINSHADE_INLINE constexpr T& at() {
    return const_cast<T&>(static_cast<const vec&>(*this).at<i>());
  }
  template <int i>
  TWINSHADE_INLINE constexpr const T& at() const {
    static_assert(i >= 0 && i < n);
    if constexpr (i == 0)
      return this->x;
    else if constexpr (i == 1)
      return this->y;
    else if constexpr (i == 2)
      return this->z;
    else
      return this->w;
  }

 private:
  struct Splat {};
  struct Parts {};
  template <int... k>
  TWINSHADE_INLINE constexpr vec(Splat, const T& value, std::integer_sequence<int, k...>)
      : detail::Components<T, n>{(static_cast<void>(k), value)...} {}
  template <int... k, class... A>
  TWINSHADE_INLINE constexpr vec(Parts, std::integer_sequence<int, k...>, const A&... parts)
      : detail::Components<T, n>{static_cast<T>(detail::nth<k>(parts...))...} {}
  template <class V>
  static TWINSHADE_INLINE constexpr auto& pick(V& v, int i) {
    if constexpr (n == 1)
      return v.x;
    else if constexpr (n == 2)
      return i == 0 ? v.x : v.y;
    else if constexpr (n == 3)
      return i == 0 ? v.x : i == 1 ? v.y : v.z;
    else
      return i == 0 ? v.x : i == 1 ? v.y : i == 2 ? v.z : v.w;
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
  template <class G>
  requires(!std::same_as<G, T> && std::convertible_to<G, T>) TWINSHADE_INLINE
      constexpr mat(const mat<G, columns, rows>& m)
      : c{} {
    for (int i = 0; i < columns; ++i) c[i] = m.c[i];
  }

  TWINSHADE_INLINE constexpr column& operator[](int i) { return c[i]; }
  TWINSHADE_INLINE constexpr const column& operator[](int i) const { return c[i]; }
  template <number::Integer E>
  TWINSHADE_INLINE constexpr column& operator[](Plain<E, 1> i) {
    return c[number::clamp_index(i.e[0], columns)];
  }
  template <number::Integer E>
  TWINSHADE_INLINE constexpr const column& operator[](Plain<E, 1> i) const {
    return c[number::clamp_index(i.e[0], columns)];
  }
};

// --- arr<T, n>: n of anything, structs and arrays included

template <class T, int n>
struct arr {
  using element = T;
  static constexpr int size = n;

  T e[n];

  TWINSHADE_INLINE constexpr T& operator[](int i) { return e[i]; }
  TWINSHADE_INLINE constexpr const T& operator[](int i) const { return e[i]; }
  template <number::Integer E>
  TWINSHADE_INLINE constexpr T& operator[](Plain<E, 1> i) {
    return e[number::clamp_index(i.e[0], n)];
  }
  template <number::Integer E>
  TWINSHADE_INLINE constexpr const T& operator[](Plain<E, 1> i) const {
    return e[number::clamp_index(i.e[0], n)];
  }
  // Uniform to varying. A conversion rather than a constructor: arr is an aggregate, arr<F, 3>{{a, b, c}}.
  template <class G>
  requires(!std::same_as<G, T> && std::convertible_to<T, G>) TWINSHADE_INLINE constexpr operator arr<G, n>() const {
    arr<G, n> r{};
    for (int i = 0; i < n; ++i) r.e[i] = e[i];
    return r;
  }
};

// --- component-wise application: scalars stand for every component

namespace detail {
template <class... A>
constexpr int vec_size() {
  int size = 0;
  ((size = Vec<A> ? Shape<A>::count : size), ...);
  return size;
}
template <int k, class F, class... A>
TWINSHADE_INLINE constexpr auto map_component(F f, const A&... a) {
  return f(component<k>(a)...);
}
template <int... k, class F, class... A>
TWINSHADE_INLINE constexpr auto map_components(std::integer_sequence<int, k...>, F f, const A&... a) {
  return vec<decltype(f(component<0>(a)...)), sizeof...(k)>(map_component<k>(f, a...)...);
}
}  // namespace detail

template <class F, class... A>
TWINSHADE_INLINE constexpr auto map(F f, const A&... a) {
  constexpr int n = detail::vec_size<A...>();
  if constexpr (n == 0)
    return f(a...);
  else
    return detail::map_components(detail::Indices<n>(), f, a...);
}
// f(f(f(v.x, v.y), v.z), v.w)
template <class F, Vec V>
TWINSHADE_INLINE constexpr auto fold(F f, const V& v) {
  if constexpr (V::size == 1)
    return v.x;
  else if constexpr (V::size == 2)
    return f(v.x, v.y);
  else if constexpr (V::size == 3)
    return f(f(v.x, v.y), v.z);
  else
    return f(f(f(v.x, v.y), v.z), v.w);
}

// clang-format off
#define TWINSHADE_VEC_OPERATOR(op)                                                                    \
  template <LaneOrVec A, LaneOrVec B>                                                                 \
    requires(Vec<A> || Vec<B>)                                                                        \
  TWINSHADE_INLINE constexpr auto operator op(const A& a, const B& b) {                               \
    return map([](const auto& x, const auto& y) TWINSHADE_LAMBDA { return x op y; }, a, b);                            \
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
  return map([](const auto& x) TWINSHADE_LAMBDA { return -x; }, a);
}
template <Vec A>
TWINSHADE_INLINE constexpr auto operator~(const A& a) {
  return map([](const auto& x) TWINSHADE_LAMBDA { return ~x; }, a);
}
template <Vec A>
TWINSHADE_INLINE constexpr auto operator!(const A& a) {
  return map([](const auto& x) TWINSHADE_LAMBDA { return !x; }, a);
}

// GLSL's == on vectors, matrices and arrays: one bool for the whole.
template <Vec A, Vec B>
TWINSHADE_INLINE constexpr auto operator==(const A& a, const B& b) {
  return fold([](const auto& x, const auto& y) TWINSHADE_LAMBDA { return x & y; },
              map([](const auto& x, const auto& y) TWINSHADE_LAMBDA { return x == y; }, a, b));
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
// One for each ==, equally constrained: C++20 would rather rewrite a == that fits better.
template <Vec A, Vec B>
TWINSHADE_INLINE constexpr auto operator!=(const A& a, const B& b) {
  return !(a == b);
}
template <Mat A, Mat B>
TWINSHADE_INLINE constexpr auto operator!=(const A& a, const B& b) {
  return !(a == b);
}
template <Arr A, Arr B>
TWINSHADE_INLINE constexpr auto operator!=(const A& a, const B& b) {
  return !(a == b);
}

// A uniform integer shifted by a varying count of the other signedness; all other shifts are friends of the lane types.
template <number::Integer E, Lane Count>
requires(Count::width != 1 && !std::same_as<typename Count::element, E>) TWINSHADE_INLINE constexpr auto operator<<(
    Plain<E, 1> a, const Count& count) {
  return typename Count::template with<E>(a) << count;
}
template <number::Integer E, Lane Count>
requires(Count::width != 1 && !std::same_as<typename Count::element, E>) TWINSHADE_INLINE constexpr auto operator>>(
    Plain<E, 1> a, const Count& count) {
  return typename Count::template with<E>(a) >> count;
}

// --- swizzles: swizzle<0, 0, 2>(v) is v.xxz

template <int... k, Vec V>
TWINSHADE_INLINE constexpr auto swizzle(const V& v) {
  return vec<typename V::element, sizeof...(k)>(v.template at<k>()...);
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
  return map([](const auto& c, const auto& x, const auto& y) TWINSHADE_LAMBDA { return select(c, x, y); }, m, a, b);
}
template <Lane M, Mat A, Mat B>
TWINSHADE_INLINE constexpr auto select(const M& m, const A& a, const B& b) {
  using T = decltype(select(m, a.c[0].x, b.c[0].x));
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

// Takes the lanes of `gone` out of each mask.
template <Lane G, Lane... M>
TWINSHADE_INLINE constexpr void leave(const G& gone, M&... masks) {
  ((masks = masks & !gone), ...);
}

}  // namespace TWINSHADE_ISA_NAMESPACE
}  // namespace twinshade
