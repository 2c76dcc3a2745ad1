// What a generated shader inherits: its invocations' inputs and outputs in the arrays of ShadeCall, its resources, and
// the loop over a block.
#pragma once

#include "cpu_shaders/runtime/aggregates.h"
#include "cpu_shaders/runtime/shader_abi.h"
#include "cpu_shaders/runtime/texels_ahead.h"

namespace twinshade {
inline namespace TWINSHADE_ISA_NAMESPACE {

namespace detail {

// One component of N::width invocations. Arrays hold N::real: integers by bit pattern in float arrays, by value in
// double ones.
template <class N, Lane T>
TWINSHADE_INLINE T load_component(const typename N::real* from) {
  using E = typename T::element;
  using R = typename T::template with<typename N::real>;
  const R x = R::load(static_cast<const typename N::real*>(__builtin_assume_aligned(from, N::width * sizeof *from)));
  if constexpr (std::same_as<E, typename N::real>)
    return x;
  else if constexpr (!N::is_exact_float)
    return x.template to<E>();
  else if constexpr (std::same_as<E, bool>)
    return x.template as<std::uint32_t>().template to<bool>();
  else
    return x.template as<E>();
}
template <class N, Lane T>
TWINSHADE_INLINE void store_component(typename N::real* to, const T& value) {
  using E = typename T::element;
  to = static_cast<typename N::real*>(__builtin_assume_aligned(to, N::width * sizeof *to));
  if constexpr (std::same_as<E, typename N::real>)
    value.store(to);
  else if constexpr (!N::is_exact_float)
    value.template to<typename N::real>().store(to);
  else if constexpr (std::same_as<E, bool>)
    value.template to<std::uint32_t>().template as<float>().store(to);
  else
    value.template as<float>().store(to);
}
// Masks in memory: words of 0 or ~0.
template <class N>
TWINSHADE_INLINE typename N::B load_mask(const std::uint32_t* from) {
  return N::U::load(from) != typename N::U(0u);
}
template <class N>
TWINSHADE_INLINE void store_mask(std::uint32_t* to, const typename N::B& m) {
  select(m, typename N::U(~0u), typename N::U(0u)).store(to);
}

// f(component number, lane of the value) for every component, in the ABI's order: element-major, column-major.
template <class T, class F>
TWINSHADE_INLINE void for_each_component(T& value, std::uint32_t& at, F f) {
  using V = std::remove_const_t<T>;
  if constexpr (Lane<V>) {
    f(at++, value);
  } else if constexpr (Vec<V>) {
    [&]<int... k>(std::integer_sequence<int, k...>) TWINSHADE_LAMBDA {
      (for_each_component(value.template at<k>(), at, f), ...);
    }
    (Indices<V::size>());
  } else if constexpr (Mat<V>) {
    for (int i = 0; i < V::column_count; ++i) for_each_component(value.c[i], at, f);
  } else {
    for (int i = 0; i < V::size; ++i) for_each_component(value.e[i], at, f);
  }
}

}  // namespace detail

template <class N>
class ShaderBase {
 public:
  using real = typename N::real;
  using F = typename N::F;
  using I = typename N::I;
  using U = typename N::U;
  using B = typename N::B;

  TWINSHADE_INLINE ShaderBase(const ShaderData& data, const ShadeCall& call) : data_(data), call_(call) {}

  // Moves to invocations first .. first + N::width - 1.
  TWINSHADE_INLINE void begin(std::uint32_t first) {
    first_ = first;
    kept = live();
    iterations_left_ = kMostIterations;
  }
  TWINSHADE_INLINE void finish() const { detail::store_mask<N>(call_.kept + first_, kept); }

  B kept;  // live and not discarded so far

  // Before each iteration of a loop whose end nobody can tell. cost: of the iterations and calls within, 1 at least.
  TWINSHADE_INLINE void iterate(std::uint32_t cost, const char* where) {
    iterations_left_ -= cost;
    if (iterations_left_ < 0) [[unlikely]]
      call_.endless_loop(where);
  }

 protected:
  template <class T>
  TWINSHADE_INLINE T input(std::uint32_t first_component) const {
    T r;
    detail::for_each_component(r, first_component, [&](std::uint32_t component, auto& lanes) TWINSHADE_LAMBDA {
      using L = std::remove_reference_t<decltype(lanes)>;
      lanes = detail::load_component<N, L>(at(call_.inputs, component));
    });
    return r;
  }
  // Element `index`, brought into [0, count), of an array that starts at `first_component`.
  template <class T, number::Integer E>
  TWINSHADE_INLINE T input(std::uint32_t first_component, std::uint32_t components, int count,
                           Plain<E, 1> index) const {
    return input<T>(first_component +
                    components * static_cast<std::uint32_t>(number::clamp_index(index.value(), count)));
  }
  template <class T>
  TWINSHADE_INLINE void output(std::uint32_t first_component, const T& value) const {
    detail::for_each_component(value, first_component,
                               [&](std::uint32_t component, const auto& lanes) TWINSHADE_LAMBDA {
                                 detail::store_component<N>(at(call_.outputs, component), varying(lanes));
                               });
  }
  TWINSHADE_INLINE vec<F, 4> frag_coord() const {
    return {
        detail::load_component<N, F>(at(call_.frag_coord, 0)), detail::load_component<N, F>(at(call_.frag_coord, 1)),
        detail::load_component<N, F>(at(call_.frag_coord, 2)), detail::load_component<N, F>(at(call_.frag_coord, 3))};
  }
  TWINSHADE_INLINE B live() const { return detail::load_mask<N>(call_.live + first_); }
  TWINSHADE_INLINE B front_facing() const { return detail::load_mask<N>(call_.front_facing + first_); }
  TWINSHADE_INLINE I primitive_id() const {
    return N::U::load(call_.primitive_id + first_).template to<std::int32_t>();
  }
  // --- compute; sx, sy, sz: the local size
  using UVec3 = vec<Plain<std::uint32_t, 1>, 3>;
  TWINSHADE_INLINE UVec3 work_group_id() const { return uniform_triple(call_.compute->group); }
  TWINSHADE_INLINE UVec3 num_work_groups() const { return uniform_triple(call_.compute->group_count); }
  TWINSHADE_INLINE U local_invocation_index() const {
    U lane;
    for (int i = 0; i < N::width; ++i) lane.set_lane(i, static_cast<std::uint32_t>(i));
    return lane + U(call_.compute->first + first_);
  }
  template <std::uint32_t sx, std::uint32_t sy, std::uint32_t sz>
  TWINSHADE_INLINE vec<U, 3> local_invocation_id() const {
    const U index = local_invocation_index();
    return {index % U(sx), index / U(sx) % U(sy), index / U(sx * sy)};
  }
  template <std::uint32_t sx, std::uint32_t sy, std::uint32_t sz>
  TWINSHADE_INLINE vec<U, 3> global_invocation_id() const {
    using UU = Plain<std::uint32_t, 1>;
    return work_group_id() * UVec3(UU(sx), UU(sy), UU(sz)) + local_invocation_id<sx, sy, sz>();
  }
  TWINSHADE_INLINE BufferView shared(std::uint32_t offset, std::uint32_t size) const {
    return {call_.compute->shared + offset, size};
  }
  TWINSHADE_INLINE void barrier() const { call_.compute->barrier(call_.compute->barrier_context); }

  TWINSHADE_INLINE void frag_depth(const F& depth) const { detail::store_component<N>(at(call_.frag_depth, 0), depth); }

  TWINSHADE_INLINE Sampler2D<real> texture_2d(std::uint32_t slot) const { return {&data_.textures[slot]}; }
  TWINSHADE_INLINE Sampler2DArray<real> texture_2d_array(std::uint32_t slot) const { return {&data_.textures[slot]}; }
  TWINSHADE_INLINE SamplerCube<real> texture_cube(std::uint32_t slot) const { return {&data_.textures[slot]}; }
  TWINSHADE_INLINE BufferView buffer(std::uint32_t slot) const { return data_.buffers[slot]; }
  // Uniforms outside blocks; `bytes` is ShaderModule::uniform_bytes. Never written through.
  TWINSHADE_INLINE BufferView uniforms(std::uint32_t bytes) const {
    return {const_cast<std::byte*>(data_.uniforms), bytes};
  }

 private:
  static TWINSHADE_INLINE UVec3 uniform_triple(const std::uint32_t (&n)[3]) {
    using UU = Plain<std::uint32_t, 1>;
    return {UU(n[0]), UU(n[1]), UU(n[2])};
  }
  TWINSHADE_INLINE const real* at(const void* array, std::uint32_t component) const {
    return static_cast<const real*>(array) + std::size_t{component} * call_.stride + first_;
  }
  TWINSHADE_INLINE real* at(void* array, std::uint32_t component) const {
    return static_cast<real*>(array) + std::size_t{component} * call_.stride + first_;
  }
  // An output may be computed from uniforms alone.
  template <Lane T>
  static TWINSHADE_INLINE auto varying(const T& x) {
    return typename F::template with<typename T::element>(x);
  }

  const ShaderData& data_;
  const ShadeCall& call_;
  std::uint32_t first_ = 0;
  std::int64_t iterations_left_ = 0;
};

// The body of an entry: S<N> is run over the block in steps of N::width. Static: g++ 12 gives a function whose template
// argument is a template of an unnamed namespace a weak symbol, and all shaders of a binary would become the first.
template <template <class> class S, class N>
TWINSHADE_WHOLE static void shade_all(const ShaderData& data, const ShadeCall& call) {
  S<N> shader(data, call);
  std::conditional_t<is_simd<N>, TexelPrefetch<N>, NoTexelPrefetch> texels(data, call);
  for (std::uint32_t first = 0; first < call.count; first += N::width) {
    texels.ask_until(first + kInvocationsAhead + N::width);
    shader.begin(first);
    shader.run();
    shader.finish();
  }
}

}  // namespace TWINSHADE_ISA_NAMESPACE
}  // namespace twinshade
