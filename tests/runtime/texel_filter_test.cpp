// Filters of several floats, given where their texels are.
#include <doctest/doctest.h>

#include <cstring>
#include <random>
#include <type_traits>
#include <vector>

#include "cpu_shaders/runtime/runtime.h"

namespace twinshade::test {
namespace {

using namespace served::detail;

constexpr std::uint32_t kWidth = 9, kHeight = 7;

// Texels of `floats` floats, and taps of W lanes whose right texels are those after the left ones.
template <int W>
struct Texture {
  std::vector<float> texels;
  Taps<W> taps;

  explicit Texture(std::uint32_t floats) : texels(kWidth * kHeight * floats) {
    std::mt19937 random(floats);
    for (float& x : texels) x = float(random() % 4096) * 0x1p-7f - 16.0f;
    for (int lane = 0; lane < W; ++lane) {
      const std::uint32_t x = std::uint32_t(random() % (kWidth - 1)), y = std::uint32_t(random() % (kHeight - 1));
      const std::uint32_t low = (y * kWidth + x) * floats / 2, high = low + kWidth * floats / 2;
      taps.at.x.set_lane(lane, low);
      taps.at.y.set_lane(lane, low + floats / 2);
      taps.at.z.set_lane(lane, high);
      taps.at.w.set_lane(lane, high + floats / 2);
      taps.weight.x.set_lane(lane, float(random() % 1000) * 0.001f);
      taps.weight.y.set_lane(lane, float(random() % 1000) * 0.001f);
      taps.weight.z.set_lane(lane, float(random() % 1000) * 0.001f);
      taps.weight.w.set_lane(lane, float(random() % 1000) * 0.001f);
    }
  }
  // Knows no right texel.
  Taps<W> left_taps() const {
    Taps<W> left = taps;
    left.at.y = left.at.w = Simd<std::uint32_t, W>(~0u);
    return left;
  }
};

template <class T>
bool same_bits(const T& a, const T& b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

}  // namespace

TEST_CASE_TEMPLATE("a filter that finds right texels from left ones gives the bits of one that is given both", Lanes,
                   std::integral_constant<int, 4>, std::integral_constant<int, 8>, std::integral_constant<int, 16>) {
  constexpr int W = Lanes::value;
  using F = Simd<float, W>;
  {
    const Texture<W> texture(12);  // three layers
    vec<F, 4> both[3], left[3];
    filter_layers<3>(texture.texels.data(), TapTable<W, 4>(texture.taps), both);
    filter_layers<3>(texture.texels.data(), TapTable<W, 4, true>(texture.left_taps(), 12), left);
    CHECK(same_bits(both, left));
  }
  {
    const Texture<W> texture(40);  // colours of eleven layers, with what pads the last one
    arr<vec<F, 3>, 11> both, left;
    filter_colors<11>(texture.texels.data(), TapTable<W, 4>(texture.taps), both);
    filter_colors<11>(texture.texels.data(), TapTable<W, 4, true>(texture.left_taps(), 40), left);
    CHECK(same_bits(both, left));
  }
}

}  // namespace twinshade::test
