// Asks for texels before the shader reads them. Where a large texture repeats, neighbouring pixels read texels far from
// each other: most are in no near cache, and a shader that meets them one after another waits for each. Nothing that is
// computed depends on it.
#pragma once

#include "cpu_shaders/runtime/texture.h"

namespace twinshade {
inline namespace TWINSHADE_ISA_NAMESPACE {

// How far ahead of the invocations that are shaded: some hundred nanoseconds.
inline constexpr std::uint32_t kInvocationsAhead = 16;

// Of the invocations first .. first + N::width - 1.
template <class N>
TWINSHADE_APART void ask_for_texels(const ShaderData& data, const ShadeCall& call, std::uint32_t first) {
  using F = typename N::F;
  using I = typename N::I;
  using U = typename N::U;
  for (std::uint32_t k = 0; k < call.ahead_count; ++k) {
    const TexelsAhead& ahead = call.ahead[k];
    const TextureView& view = data.textures[ahead.texture];
    const auto component = [&](std::uint32_t c) TWINSHADE_LAMBDA {
      return F::load(static_cast<const float*>(call.inputs) + std::size_t{c} * call.stride + first);
    };
    const auto x = detail::linear_taps(component(ahead.coordinates), view.width, Wrap::repeat);
    const auto y = detail::linear_taps(component(ahead.coordinates + 1), view.height, Wrap::repeat);
    U slice(0u);
    if (ahead.layer >= 0) {
      const I layer = component(static_cast<std::uint32_t>(ahead.layer)).template as<std::int32_t>();
      slice =
          detail::clamp_to_size(layer, view.layers).template to<std::uint32_t>() * detail::pitch<U>(view.layer_pitch);
    }
    // In twos of floats, the largest scale of an x86 address.
    const U texel = slice + detail::texel_index(view, x.first, y.first);
    alignas(64) std::uint32_t at[N::width];
    (texel + texel).store(at);
    // Really through memory: compilers would take registers apart lane by lane. Volatile: g++ sees no effect in
    // prefetches and leaves out calls of functions that have nothing else.
    __asm__ volatile("" : "+m"(at));
    // The two texels of a row, which lie in one cache line or two, and those of the row above; where that is the
    // texture's first row again, or the texel to the right is its row's first, others are asked for.
    const auto texels = reinterpret_cast<std::uintptr_t>(view.texels);
    const std::uintptr_t right = texels + 2 * static_cast<std::uintptr_t>(view.texel_pitch) * sizeof(float) - 1;
    const std::uintptr_t above = static_cast<std::uintptr_t>(view.row_pitch) * sizeof(float);
    for (int lane = 0; lane < N::width; ++lane)
      for (const std::uintptr_t from : {texels, right, texels + above, right + above})
        __builtin_prefetch(reinterpret_cast<const void*>(from + std::uintptr_t{at[lane]} * 8));
  }
}

}  // namespace TWINSHADE_ISA_NAMESPACE
}  // namespace twinshade
