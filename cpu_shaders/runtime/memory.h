// Uniform blocks and storage buffers: 4-byte words at byte offsets. Reads outside the view give 0, writes outside are
// dropped, in every lane, active or not. Memory holds float; Scalar64 widens what it reads and rounds what it writes.
#pragma once

#include <algorithm>

#include "cpu_shaders/runtime/aggregates.h"
#include "cpu_shaders/runtime/shader_abi.h"

namespace twinshade {
inline namespace TWINSHADE_ISA_NAMESPACE {

namespace memory {

// Elements in memory: bool is a word that is not 0, double a float.
template <class E>
TWINSHADE_INLINE E load_word(const BufferView& view, std::uint32_t offset) {
  std::uint32_t word = 0;
  if (view.size >= 4 && offset <= view.size - 4) std::memcpy(&word, view.bytes + offset, 4);
  if constexpr (std::same_as<E, bool>)
    return word != 0;
  else if constexpr (std::same_as<E, double>)
    return number::bits<float>(word);
  else
    return number::bits<E>(word);
}
template <class E>
TWINSHADE_INLINE void store_word(const BufferView& view, std::uint32_t offset, E x) {
  if (view.size < 4 || offset > view.size - 4) return;
  std::uint32_t word;
  if constexpr (std::same_as<E, bool>)
    word = x ? 1 : 0;
  else if constexpr (std::same_as<E, double>)
    word = number::bits<std::uint32_t>(static_cast<float>(x));
  else
    word = number::bits<std::uint32_t>(x);
  std::memcpy(view.bytes + offset, &word, 4);
}

// Lane types are written and read through arrays of their elements.
template <Lane T, class F>
TWINSHADE_INLINE T fill(F f) {
  T r{};
  for (int i = 0; i < T::width; ++i) r.set_lane(i, f(i));
  return r;
}

}  // namespace memory

// T: a scalar or vec, tightly packed at `offset`. Uniform T goes with a uniform offset.
template <LaneOrVec T, Lane Offset>
TWINSHADE_INLINE T load(const BufferView& view, const Offset& offset) {
  if constexpr (Vec<T>) {
    return [&]<int... k>(std::integer_sequence<int, k...>) TWINSHADE_LAMBDA {
      return T(load<typename T::element>(view, offset + Offset(static_cast<typename Offset::element>(4 * k)))...);
    }
    (detail::Indices<T::size>());
  } else {
    using E = typename T::element;
    if constexpr (Offset::width == 1) {
      return T(memory::load_word<E>(view, static_cast<std::uint32_t>(offset.value())));
    } else {
      return memory::fill<T>([&](int i) TWINSHADE_LAMBDA {
        return memory::load_word<E>(view, static_cast<std::uint32_t>(offset.lane(i)));
      });
    }
  }
}

// Active lanes in order: where several write to one place, the last wins.
template <Lane M, Lane Offset, LaneOrVec V>
TWINSHADE_INLINE void store(const M& m, const BufferView& view, const Offset& offset, const V& value) {
  if constexpr (Vec<V>) {
    [&]<int... k>(std::integer_sequence<int, k...>) TWINSHADE_LAMBDA {
      (store(m, view, offset + Offset(static_cast<typename Offset::element>(4 * k)), value.template at<k>()), ...);
    }
    (detail::Indices<V::size>());
  } else {
    using Element = typename V::element;
    constexpr int lanes = std::max({M::width, Offset::width, V::width});
    for (int i = 0; i < lanes; ++i) {
      if (!m.lane(M::width == 1 ? 0 : i)) continue;
      memory::store_word<Element>(view, static_cast<std::uint32_t>(offset.lane(Offset::width == 1 ? 0 : i)),
                                  value.lane(V::width == 1 ? 0 : i));
    }
  }
}

// Elements of a runtime-sized array, `stride` bytes each, that starts at `first_byte`.
TWINSHADE_INLINE Plain<std::uint32_t, 1> array_length(const BufferView& view, std::uint32_t first_byte,
                                                      std::uint32_t stride) {
  const std::size_t bytes = view.size > first_byte ? view.size - first_byte : 0;
  return Plain<std::uint32_t, 1>(static_cast<std::uint32_t>(bytes / stride));
}

namespace memory {

// One read-modify-write per active lane of the mask, in lane order; gives what was there before.
template <Lane M, Lane Offset, Lane V, class F>
TWINSHADE_INLINE auto atomic(const M& m, const BufferView& view, const Offset& offset, const V& value, F f) {
  using E = typename V::element;
  static_assert(number::Integer<E>);
  typename M::template with<E> before(E{0});
  for (int i = 0; i < M::width; ++i) {
    if (!m.lane(i)) continue;
    const auto at = static_cast<std::uint32_t>(offset.lane(Offset::width == 1 ? 0 : i));
    if (view.size < 4 || at > view.size - 4 || at % 4 != 0) continue;
    const E operand = value.lane(V::width == 1 ? 0 : i);
    E* const word = reinterpret_cast<E*>(view.bytes + at);
    E old = __atomic_load_n(word, __ATOMIC_RELAXED);
    while (!__atomic_compare_exchange_n(word, &old, f(i, old, operand), false, __ATOMIC_RELAXED, __ATOMIC_RELAXED)) {
    }
    before.set_lane(i, old);
  }
  return before;
}

}  // namespace memory

// clang-format off
#define TWINSHADE_ATOMIC(name, result)                                                                         \
  template <Lane M, Lane Offset, Lane V>                                                                       \
  TWINSHADE_INLINE auto name(const M& m, const BufferView& view, const Offset& offset, const V& value) {       \
    using E = typename V::element;                                                                             \
    return memory::atomic(m, view, offset, value, [](int, E old, E x) TWINSHADE_LAMBDA { (void)old; return E(result); });       \
  }
TWINSHADE_ATOMIC(atomic_add, number::add(old, x))
TWINSHADE_ATOMIC(atomic_min, number::minimum(old, x))
TWINSHADE_ATOMIC(atomic_max, number::maximum(old, x))
TWINSHADE_ATOMIC(atomic_and, old & x)
TWINSHADE_ATOMIC(atomic_or, old | x)
TWINSHADE_ATOMIC(atomic_xor, old ^ x)
TWINSHADE_ATOMIC(atomic_exchange, x)
#undef TWINSHADE_ATOMIC
// clang-format on
template <Lane M, Lane Offset, Lane C, Lane V>
TWINSHADE_INLINE auto atomic_comp_swap(const M& m, const BufferView& view, const Offset& offset, const C& compare,
                                       const V& value) {
  using E = typename V::element;
  return memory::atomic(m, view, offset, value, [&](int i, E old, E x) TWINSHADE_LAMBDA {
    return old == compare.lane(C::width == 1 ? 0 : i) ? x : old;
  });
}

}  // namespace TWINSHADE_ISA_NAMESPACE
}  // namespace twinshade
