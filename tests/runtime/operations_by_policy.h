// For the files that are compiled once per instruction set. Nothing of the standard library with code in it: such code
// could win at link time over that of the baseline.
#pragma once

#include "cpu_shaders/runtime/runtime.h"
#include "tests/runtime/operations.h"

namespace twinshade {
inline namespace TWINSHADE_ISA_NAMESPACE {
namespace {

using test::Operation;
using test::OperationSet;
using test::OperationSets;

template <Lane T>
TWINSHADE_INLINE auto as_words(const T& x) {
  if constexpr (std::same_as<typename T::element, bool>)
    return x.template to<std::uint32_t>();
  else
    return x.template as<std::uint32_t>();
}

// Runs f(a, b, c), words of N, over all rows and stores each component of what it returns.
template <class N, class F>
TWINSHADE_INLINE void run_rows(F f, const std::uint32_t* a, const std::uint32_t* b, const std::uint32_t* c,
                               std::uint32_t* out, std::size_t count) {
  using U = typename N::U;
  for (std::size_t i = 0; i < count; i += N::width) {
    const auto value = f(U::load(a + i), U::load(b + i), U::load(c + i));
    std::uint32_t component = 0;
    detail::for_each_component(value, component, [&](std::uint32_t k, const auto& lanes) TWINSHADE_LAMBDA {
      U(as_words(lanes)).store(out + k * count + i);
    });
  }
}

template <class T>
constexpr int component_count() {
  if constexpr (Lane<T>)
    return 1;
  else if constexpr (Vec<T> || Mat<T>)
    return detail::Shape<T>::count;
  else
    return T::size * component_count<typename T::element>();
}
template <class T>
constexpr bool is_real() {
  if constexpr (Lane<T>)
    return number::Real<typename T::element>;
  else
    return is_real<typename T::element>();
}
template <class N, class F>
using ResultOf = decltype(F()(typename N::U(0u), typename N::U(0u), typename N::U(0u)));

template <class N, class F>
constexpr Operation operation(const char* name, F) {
  using R = ResultOf<N, F>;
  return {name, component_count<R>(), is_real<R>(),
          [](const std::uint32_t* a, const std::uint32_t* b, const std::uint32_t* c, std::uint32_t* out,
             std::size_t count) { run_rows<N>(F(), a, b, c, out, count); }};
}

// In an operation: p q r are the words as uint, i j k as int, a b c as float.
#define OPERATION(name, ...)                                                                  \
  operation<N>(name, [](typename N::U p, typename N::U q, typename N::U r) TWINSHADE_LAMBDA { \
    using F [[maybe_unused]] = typename N::F;                                                 \
    using I [[maybe_unused]] = typename N::I;                                                 \
    using U [[maybe_unused]] = typename N::U;                                                 \
    using B [[maybe_unused]] = typename N::B;                                                 \
    using UF [[maybe_unused]] = typename N::UF;                                               \
    using UI [[maybe_unused]] = typename N::UI;                                               \
    using UU [[maybe_unused]] = typename N::UU;                                               \
    [[maybe_unused]] const F a = p.template as<float>();                                      \
    [[maybe_unused]] const F b = q.template as<float>();                                      \
    [[maybe_unused]] const F c = r.template as<float>();                                      \
    [[maybe_unused]] const I i = p.template as<std::int32_t>();                               \
    [[maybe_unused]] const I j = q.template as<std::int32_t>();                               \
    [[maybe_unused]] const I k = r.template as<std::int32_t>();                               \
    __VA_ARGS__                                                                               \
  })

// A file defines `template <class N> struct Group { static constexpr Operation list[] = {...}; };` and then says
// OPERATION_SETS(arithmetic). All lane counts on every instruction set; scalar and quad with the baseline.
template <template <class> class Group, class N>
constexpr OperationSet set_of(const char* policy) {
  return {policy, Group<N>::list, static_cast<int>(sizeof Group<N>::list / sizeof *Group<N>::list)};
}
#if TWINSHADE_ISA_NUMBER == 0
#define OPERATION_SETS_SCALAR , set_of<Group, Scalar32>("scalar"), set_of<Group, Quad32>("quad")
#else
#define OPERATION_SETS_SCALAR
#endif
#define OPERATION_SETS(group)                                                                                     \
  }                                                                                                               \
  }                                                                                                               \
  test::OperationSets test::TWINSHADE_JOIN(group##_operations_, TWINSHADE_ISA)() {                                \
    static constexpr OperationSet sets[] = {set_of<Group, Lanes<4>>("lanes4"), set_of<Group, Lanes<8>>("lanes8"), \
                                            set_of<Group, Lanes<16>>("lanes16") OPERATION_SETS_SCALAR};           \
    return {sets, static_cast<int>(sizeof sets / sizeof *sets)};                                                  \
  }                                                                                                               \
  inline namespace TWINSHADE_ISA_NAMESPACE {                                                                      \
  namespace {

}  // namespace
}  // namespace TWINSHADE_ISA_NAMESPACE
}  // namespace twinshade
