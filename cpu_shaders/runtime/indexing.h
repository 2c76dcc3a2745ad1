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

// A table of uniform numbers, `at(i)` its entry i, looked up by varying index: by permutes where the table fits a
// register.
template <int n, class E, Lane I, class At>
TWINSHADE_INLINE auto lookup_uniform(At at, const I& index) {
  using R = typename I::template with<E>;
  constexpr int W = I::width;
  if constexpr (n <= 16 && !std::same_as<I, Plain<std::int32_t, W>> && registers::has_permute16<W>) {
    const auto entry = [&](int i) { return number::bits<std::int32_t>(i < n ? at(i) : E{0}); };
    R r;
#if defined(__AVX512F__)
    if constexpr (W == 16) {
      const Int16 table = {entry(0), entry(1), entry(2),  entry(3),  entry(4),  entry(5),  entry(6),  entry(7),
                           entry(8), entry(9), entry(10), entry(11), entry(12), entry(13), entry(14), entry(15)};
      r.v = (typename R::Vector)registers::permute16(table, index.v);
    }
#endif
#if defined(__AVX2__)
    if constexpr (W == 8) {
      const Int8 low = {entry(0), entry(1), entry(2), entry(3), entry(4), entry(5), entry(6), entry(7)};
      if constexpr (n <= 8) {
        r.v = (typename R::Vector)registers::permute8(low, index.v);
      } else {
        const Int8 high = {entry(8), entry(9), entry(10), entry(11), entry(12), entry(13), entry(14), entry(15)};
        r.v = (typename R::Vector)registers::permute16(low, high, index.v);
      }
    }
#endif
    return r;
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
      return lookup_uniform<n, typename T::element>([&](int i) { return entry(i).value(); }, index);
    } else {
      T r = entry(0);
      for (int i = 1; i < n; ++i) r = select(index == I(i), entry(i), r);
      return r;
    }
  } else if constexpr (Vec<T>) {
    using E = typename T::element;
    typename Varying<T, I>::type r;
    for (int k = 0; k < T::size; ++k) {
      r.e[k] = lookup_element<n, E>([&](int i) -> const E& { return entry(i).e[k]; }, index);
    }
    return r;
  } else if constexpr (Mat<T>) {
    using E = typename T::column;
    typename Varying<T, I>::type r;
    for (int k = 0; k < T::column_count; ++k) {
      r.c[k] = lookup_element<n, E>([&](int i) -> const E& { return entry(i).c[k]; }, index);
    }
    return r;
  } else if constexpr (Arr<T>) {
    using E = typename T::element;
    typename Varying<T, I>::type r;
    for (int k = 0; k < T::size; ++k) {
      r.e[k] = lookup_element<n, E>([&](int i) -> const E& { return entry(i).e[k]; }, index);
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
  return detail::lookup_element<n, T>([&](int i) -> const T& { return a.e[i]; }, detail::clamped_index<n>(index));
}
template <class T, int n, Lane Index>
TWINSHADE_INLINE constexpr auto lookup(const vec<T, n>& v, const Index& index) {
  return detail::lookup_element<n, T>([&](int i) -> const T& { return v.e[i]; }, detail::clamped_index<n>(index));
}
template <class T, int c, int r, Lane Index>
TWINSHADE_INLINE constexpr auto lookup(const mat<T, c, r>& m, const Index& index) {
  using C = typename mat<T, c, r>::column;
  return detail::lookup_element<c, C>([&](int i) -> const C& { return m.c[i]; }, detail::clamped_index<c>(index));
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

}  // namespace TWINSHADE_ISA_NAMESPACE
}  // namespace twinshade
