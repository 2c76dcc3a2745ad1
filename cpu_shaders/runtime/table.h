// table<T, n>: a small uniform array made for dynamic indexing. Its numbers lie one component after another (structure
// of arrays, padded, aligned), so that a varying index is a permute of registers where the array fits, a gather beyond.
#pragma once

#include "cpu_shaders/runtime/indexing.h"

namespace twinshade {
inline namespace TWINSHADE_ISA_NAMESPACE {

namespace detail {

// column[index] for n entries, padded to a multiple of 16 and aligned to 64 bytes; index in range.
template <int n, class E, Lane I>
TWINSHADE_INLINE auto lookup_column(const E* column, const I& index) {
  using R = typename I::template with<E>;
  [[maybe_unused]] constexpr int W = I::width;
  if constexpr (std::same_as<I, Plain<std::int32_t, W>>) {
    R r;
    for (int i = 0; i < W; ++i) r.e[i] = column[index.e[i]];
    return r;
  } else {
    [[maybe_unused]] const auto words = reinterpret_cast<const std::int32_t*>(column);
#if defined(__AVX512F__)
    if constexpr (W == 16 && n <= 16) {
      R r;
      r.v = (typename R::Vector)registers::permute16(registers::load<16>(words), index.v);
      return r;
    } else if constexpr (W == 16 && n <= 32) {
      R r;
      r.v = (typename R::Vector)registers::permute32(registers::load<16>(words), registers::load<16>(words + 16),
                                                     index.v);
      return r;
    } else
#endif
#if defined(__AVX2__)
        if constexpr (W == 8 && n <= 8) {
      R r;
      r.v = (typename R::Vector)registers::permute8(registers::load<8>(words), index.v);
      return r;
    } else if constexpr (W == 8 && n <= 16) {
      R r;
      r.v = (typename R::Vector)registers::permute16(registers::load<8>(words), registers::load<8>(words + 8), index.v);
      return r;
    } else
#endif
    {
      return R::gather(column, index);
    }
  }
}

template <class T>
concept UniformNumber = Lane<T> && T::width == 1 && !std::same_as<typename T::element, bool>;

template <class T>
struct UniformVec : std::false_type {};
template <UniformNumber T, int n>
struct UniformVec<vec<T, n>> : std::true_type {};

}  // namespace detail

// Anything else than uniform numbers and vectors of them: the array itself.
template <class T, int n>
struct table : arr<T, n> {
  constexpr table(const arr<T, n>& a) : arr<T, n>(a) {}
};
template <class T, int n, Lane Index>
TWINSHADE_INLINE constexpr auto lookup(const table<T, n>& t, const Index& index) {
  return lookup(static_cast<const arr<T, n>&>(t), index);
}

template <detail::UniformNumber T, int n>
struct table<T, n> {
  using E = typename T::element;
  alignas(64) E column[(n + 15) / 16 * 16];

  constexpr table(const arr<T, n>& a) : column{} {
    for (int i = 0; i < n; ++i) column[i] = a.e[i].value();
  }
  TWINSHADE_INLINE constexpr T operator[](int i) const { return T(column[i]); }
  template <number::Integer I>
  TWINSHADE_INLINE constexpr T operator[](Plain<I, 1> i) const {
    return T(column[number::clamp_index(i.e[0], n)]);
  }
  // The whole array, uniform or varying.
  template <class G>
  requires std::convertible_to<T, G> TWINSHADE_INLINE constexpr operator arr<G, n>() const {
    arr<G, n> r{};
    for (int i = 0; i < n; ++i) r.e[i] = (*this)[i];
    return r;
  }
};
template <detail::UniformNumber T, int n, Lane Index>
TWINSHADE_INLINE constexpr auto lookup(const table<T, n>& t, const Index& index) {
  return detail::lookup_column<n>(t.column, detail::clamped_index<n>(index));
}

template <class T, int n>
requires detail::UniformVec<T>::value struct table<T, n> {
  using E = typename T::element::element;
  alignas(64) E columns[T::size][(n + 15) / 16 * 16];

  constexpr table(const arr<T, n>& a) : columns{} {
    for (int i = 0; i < n; ++i) {
      for (int k = 0; k < T::size; ++k) columns[k][i] = a.e[i][k].value();
    }
  }
  TWINSHADE_INLINE constexpr T operator[](int i) const { return entry(i, detail::Indices<T::size>()); }
  template <number::Integer I>
  TWINSHADE_INLINE constexpr T operator[](Plain<I, 1> i) const {
    return entry(number::clamp_index(i.e[0], n), detail::Indices<T::size>());
  }
  // The whole array, uniform or varying.
  template <class G>
  requires std::convertible_to<T, G> TWINSHADE_INLINE constexpr operator arr<G, n>() const {
    arr<G, n> r{};
    for (int i = 0; i < n; ++i) r.e[i] = (*this)[i];
    return r;
  }
  template <Lane I, int... k>
  TWINSHADE_INLINE constexpr auto entries(const I& index, std::integer_sequence<int, k...>) const {
    return vec<typename I::template with<E>, T::size>(detail::lookup_column<n>(columns[k], index)...);
  }

 private:
  template <int... k>
  TWINSHADE_INLINE constexpr T entry(int i, std::integer_sequence<int, k...>) const {
    return T(typename T::element(columns[k][i])...);
  }
};
template <class T, int n, Lane Index>
requires detail::UniformVec<T>::value TWINSHADE_INLINE constexpr auto lookup(const table<T, n>& t, const Index& index) {
  return t.entries(detail::clamped_index<n>(index), detail::Indices<T::size>());
}

}  // namespace TWINSHADE_ISA_NAMESPACE
}  // namespace twinshade
