// Dynamic indexing. Every lane's index is clamped into range, active or not: inactive lanes index memory too.
#pragma once

#include "cpu_shaders/runtime/aggregates.h"

namespace twinshade {
inline namespace TWINSHADE_ISA_NAMESPACE {

namespace detail {

// int and uint indices alike: as uint, clamped to n - 1; a negative int counts as 0.
template <int n, Lane Index>
TWINSHADE_INLINE constexpr auto clamped_index(const Index& index) {
  using I = typename Index::template with<std::int32_t>;
  if constexpr (std::same_as<typename Index::element, std::int32_t>) {
    return lanes_max(lanes_min(index, I(n - 1)), I(0));
  } else {
    using U = Index;
    return lanes_min(index, U(static_cast<std::uint32_t>(n - 1))).template to<std::int32_t>();
  }
}

// Uniform numbers, `at(i)` being entry i, picked by varying index.
template <class E, Lane I, class At>
TWINSHADE_INLINE constexpr auto lookup_uniform(At at, const I& index) {
  using R = typename I::template with<E>;
  if constexpr (std::same_as<E, bool>) {
    return lookup_uniform<std::int32_t>([&](int i) TWINSHADE_LAMBDA { return at(i) ? 1 : 0; }, index)
        .template to<bool>();
  } else {
    E entries[I::width];
    for (int i = 0; i < I::width; ++i) entries[i] = at(index.lane(i));
    return R::load(entries);
  }
}

}  // namespace detail

// What an element becomes once looked up with an index of `width` lanes. Generated structs say `template <int> using
// varying = ...` if they can hold uniforms; those that are varying already need nothing.
template <class T, class I>
struct Varying {
  using type = T;
};
template <class E, class I>
struct Varying<Plain<E, 1>, I> {
  using type = typename I::template with<E>;
};
template <class T, int n, class I>
struct Varying<vec<T, n>, I> {
  using type = vec<typename Varying<T, I>::type, n>;
};
template <class T, int c, int r, class I>
struct Varying<mat<T, c, r>, I> {
  using type = mat<typename Varying<T, I>::type, c, r>;
};
template <class T, int n, class I>
struct Varying<arr<T, n>, I> {
  using type = arr<typename Varying<T, I>::type, n>;
};

namespace detail {

// The element `index` of n elements of type T, entry(i) being element i; index in range.
template <int n, class T, Lane I, class Entry>
TWINSHADE_INLINE constexpr auto lookup_element(Entry entry, const I& index) {
  if constexpr (I::width == 1) {
    return entry(index.value());
  } else if constexpr (Lane<T>) {
    if constexpr (T::width == 1) {
      return lookup_uniform<typename T::element>([&](int i) TWINSHADE_LAMBDA { return entry(i).value(); }, index);
    } else {
      T r = entry(0);
      for (int i = 1; i < n; ++i) r = select(index == I(i), entry(i), r);
      return r;
    }
  } else if constexpr (Vec<T>) {
    using E = typename T::element;
    const auto component = [&]<int k>(std::integral_constant<int, k>) TWINSHADE_LAMBDA {
      return lookup_element<n, E>([&](int i) TWINSHADE_LAMBDA -> const E& { return entry(i).template at<k>(); }, index);
    };
    return [&]<int... k>(std::integer_sequence<int, k...>) TWINSHADE_LAMBDA {
      return typename Varying<T, I>::type(component(std::integral_constant<int, k>())...);
    }
    (Indices<T::size>());
  } else if constexpr (Mat<T>) {
    using E = typename T::column;
    typename Varying<T, I>::type r;
    for (int k = 0; k < T::column_count; ++k) {
      r.c[k] = lookup_element<n, E>([&](int i) TWINSHADE_LAMBDA -> const E& { return entry(i).c[k]; }, index);
    }
    return r;
  } else if constexpr (Arr<T>) {
    using E = typename T::element;
    typename Varying<T, I>::type r;
    for (int k = 0; k < T::size; ++k) {
      r.e[k] = lookup_element<n, E>([&](int i) TWINSHADE_LAMBDA -> const E& { return entry(i).e[k]; }, index);
    }
    return r;
  } else {  // a struct: its select
    T r = entry(0);
    for (int i = 1; i < n; ++i) r = select(index == I(i), entry(i), r);
    return r;
  }
}

}  // namespace detail

// array[index], vector[index] (a component), matrix[index] (a column).
template <class T, int n, Lane Index>
TWINSHADE_INLINE constexpr auto lookup(const arr<T, n>& a, const Index& index) {
  return detail::lookup_element<n, T>([&](int i) TWINSHADE_LAMBDA -> const T& { return a.e[i]; },
                                      detail::clamped_index<n>(index));
}
template <class T, int n, Lane Index>
TWINSHADE_INLINE constexpr auto lookup(const vec<T, n>& v, const Index& index) {
  return detail::lookup_element<n, T>([&](int i) TWINSHADE_LAMBDA -> const T& { return v[i]; },
                                      detail::clamped_index<n>(index));
}
template <class T, int c, int r, Lane Index>
TWINSHADE_INLINE constexpr auto lookup(const mat<T, c, r>& m, const Index& index) {
  using C = typename mat<T, c, r>::column;
  return detail::lookup_element<c, C>([&](int i) TWINSHADE_LAMBDA -> const C& { return m.c[i]; },
                                      detail::clamped_index<c>(index));
}

// array[index] = value in the lanes of the mask. The array is varying wherever mask, index or value are.
template <Lane M, class A, Lane Index, class V>
TWINSHADE_INLINE constexpr void store_lookup(const M& m, A& target, const Index& index, const V& value) {
  constexpr int n = [] {
    if constexpr (Mat<A>)
      return A::column_count;
    else
      return A::size;
  }();
  const auto at = detail::clamped_index<n>(index);
  if constexpr (Index::width == 1) {
    assign(m, target[at.value()], value);
  } else {
    for (int i = 0; i < n; ++i) assign(m & (at == decltype(at)(i)), target[i], value);
  }
}

// f(mask of the lanes that mean element k, element k) for every element that some lane of the mask means.
template <Lane M, class A, Lane Index, class F>
TWINSHADE_INLINE void update(const M& m, A& target, const Index& index, F f) {
  constexpr int n = [] {
    if constexpr (Mat<A>)
      return A::column_count;
    else
      return A::size;
  }();
  const auto at = detail::clamped_index<n>(index);
  for (int i = 0; i < n; ++i) {
    const auto here = m & (at == decltype(at)(i));
    if (any(here)) f(here, target[i]);
  }
}

}  // namespace TWINSHADE_ISA_NAMESPACE
}  // namespace twinshade
