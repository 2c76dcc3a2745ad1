// Asks for texels of large textures before the shader reads them: most are in no near cache, and a shader that meets
// them one after another waits for each. Where a texture repeats, neighbouring pixels read texels far from each other.
// Where it does not it is laid over the scene once, as a lightmap is, and most read the same: only some are looked at.
// Nothing that is computed depends on it.
#pragma once

#include "cpu_shaders/runtime/texture.h"

namespace twinshade {
inline namespace TWINSHADE_ISA_NAMESPACE {

// How far ahead of the invocations that are shaded: some hundred nanoseconds.
inline constexpr std::uint32_t kInvocationsAhead = 16;

// For the invocations of one call, from the first on. Addresses are found for many invocations at a time, since what is
// the same for all of them takes longer than what is not; texels are asked for by and by.
template <class N>
class TexelPrefetch {
 public:
  TWINSHADE_INLINE TexelPrefetch(const ShaderData& data, const ShadeCall& call)
      : data_(data),
        call_(call),
        count_(call.ahead_count < kMost ? call.ahead_count : kMost),
        end_(count_ > 0 ? call.count : 0) {}

  // Those of all invocations before `end` that were not asked for yet.
  TWINSHADE_INLINE void ask_until(std::uint32_t end) {
    while (asked_ < end && asked_ < end_) ask();
  }

 private:
  using F = typename N::F;
  using I = typename N::I;
  using U = typename N::U;
  static constexpr std::uint32_t kMost = 8, kFound = 256;

  // Of the texel at 0 and its neighbour to the right, and of those in the row above: the first byte, and how far away
  // the others are that stand for a line of memory each. Where the row above is the texture's first again, or the
  // neighbour its row's first, others are asked for.
  struct Lines {
    std::uintptr_t row, above;
    std::uint32_t count, distance;
    bool of_all_lanes;  // else of the first and the last of each eight
  };

  TWINSHADE_FUNCTION void ask() {
    const std::uint32_t first = asked_ % kFound;
    if (first == 0) find();
    const std::uint32_t* at = at_[0] + first;
    for (const Lines *of = lines_, *end = lines_ + count_; of != end; ++of, at += kFound) {
      if (of->of_all_lanes) {
        for (int lane = 0; lane < N::width; ++lane)
          for (const std::uintptr_t row : {of->row, of->above}) {
            ask(row + at[lane]);
            ask(row + of->distance + at[lane]);
          }
      } else {
        constexpr int kBetween = N::width < 8 ? N::width : 8;
        for (std::uint32_t line = 0; line < of->count * of->distance; line += of->distance)
          for (int lane = 0; lane < N::width; lane += kBetween)
            for (const std::uintptr_t row : {of->row, of->above}) {
              ask(row + line + at[lane]);
              ask(row + line + at[lane + kBetween - 1]);
            }
      }
    }
    asked_ += N::width;
  }
  static TWINSHADE_INLINE void ask(std::uintptr_t address) {
    __builtin_prefetch(reinterpret_cast<const void*>(address));
  }

  struct Axis {
    F extent;
    I last;
    bool repeats, power_of_two;
    TWINSHADE_INLINE Axis(std::int32_t size, bool does_repeat)
        : extent(static_cast<float>(size)),
          last(size - 1),
          repeats(does_repeat),
          power_of_two((size & (size - 1)) == 0) {}
    // As linear_taps has it for coordinates that are numbers within int's range: at the others' addresses nothing is
    // read.
    TWINSHADE_INLINE U first_tap(const F& s) const {
      if (!repeats)
        return whole(lanes_min(lanes_max(s * extent - F(0.5f), F(0.0f)), extent - F(1.0f)))
            .template to<std::uint32_t>();
      const I index = whole(lanes_floor((power_of_two ? s : s - lanes_floor(s)) * extent - F(0.5f)));
      return (power_of_two ? index & last : select(index < I(0), last, index)).template to<std::uint32_t>();
    }
    static TWINSHADE_INLINE I whole(const F& u) {
      return F::template each<I>(
          [](auto x) TWINSHADE_LAMBDA { return __builtin_convertvector(x, Register<std::int32_t, sizeof x / 4>); }, u);
    }
  };

  TWINSHADE_APART void find() {
    const std::uint32_t count = end_ - asked_ < kFound ? end_ - asked_ : kFound;
    for (std::uint32_t k = 0; k < count_; ++k) {
      const TexelsAhead& ahead = call_.ahead[k];
      const TextureView& view = data_.textures[ahead.texture];
      const U row = bytes(view.row_pitch), column = bytes(view.texel_pitch), slice = bytes(view.layer_pitch);
      const auto texels = reinterpret_cast<std::uintptr_t>(view.texels);
      const std::uintptr_t above = texels + static_cast<std::uintptr_t>(view.row_pitch) * sizeof(float);
      const std::uint32_t both = static_cast<std::uint32_t>(view.texel_pitch) * 2 * std::uint32_t{sizeof(float)};
      const bool repeats = view.wrap == Wrap::repeat;
      if (repeats)  // in one line or two
        lines_[k] = {texels, above, 2, both - 1, true};
      else  // where texels do not begin lines, in one more
        lines_[k] = {texels, above, (both + 63) / 64 + (both % 128 != 0), 64, false};

      const Axis across(view.width, repeats), up(view.height, repeats);
      const float* const x = component(ahead.coordinates);
      const float* const y = component(ahead.coordinates + 1);
      const float* const layer = ahead.layer < 0 ? nullptr : component(static_cast<std::uint32_t>(ahead.layer));
      for (std::uint32_t i = 0; i < count; i += N::width) {
        U at = across.first_tap(F::load(x + i)) * column + up.first_tap(F::load(y + i)) * row;
        if (layer) at = at + F::load(layer + i).template as<std::uint32_t>() * slice;
        at.store(at_[k] + i);
      }
    }
  }

  TWINSHADE_INLINE const float* component(std::uint32_t c) const {
    return static_cast<const float*>(call_.inputs) + std::size_t{c} * call_.stride + asked_;
  }
  static TWINSHADE_INLINE U bytes(std::ptrdiff_t floats) {
    return U(static_cast<std::uint32_t>(floats) * std::uint32_t{sizeof(float)});
  }

  const ShaderData& data_;
  const ShadeCall& call_;
  const std::uint32_t count_;  // hints that are taken
  const std::uint32_t end_;
  std::uint32_t asked_ = 0;
  Lines lines_[kMost];
  // In bytes from the lines, of invocations asked_ / kFound * kFound on. Beyond 4 GiB others are asked for.
  alignas(64) std::uint32_t at_[kMost][kFound];
};

// Where invocations are not lanes.
struct NoTexelPrefetch {
  NoTexelPrefetch(const ShaderData&, const ShadeCall&) {}
  void ask_until(std::uint32_t) const {}
};

}  // namespace TWINSHADE_ISA_NAMESPACE
}  // namespace twinshade
