#include "tests/runtime/operations.h"

#include <cstring>
#include <vector>

namespace twinshade::test {
namespace {

// Texel (x, y, layer), channel c: different everywhere, signs mixed.
float texel(int x, int y, int layer, int c) {
  return static_cast<float>((x * 7 + y * 13 + layer * 29 + c * 3) % 31 - 15) * 0.125f +
         static_cast<float>(x) * 0x1p-12f;
}

struct TestTexture {
  TestTexture(int width, int height, int layers, TextureKind kind, Filter filter, Wrap wrap, int padding) {
    const std::ptrdiff_t pitch = (width + padding) * 4, layer_pitch = pitch * (height + padding);
    texels.resize(static_cast<std::size_t>(layer_pitch) * static_cast<std::size_t>(layers));
    for (int z = 0; z < layers; ++z) {
      for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
          for (int c = 0; c < 4; ++c) {
            texels[static_cast<std::size_t>(z * layer_pitch + y * pitch + x * 4 + c)] = texel(x, y, z, c);
          }
        }
      }
    }
    view = {texels.data(), width, height, layers, pitch, layer_pitch, kind, filter, wrap};
  }
  std::vector<float> texels;
  TextureView view;
};

}  // namespace

const TextureView& test_texture(int kind) {
  static const TestTexture textures[] = {
      {7, 5, 1, TextureKind::two_d, Filter::linear, Wrap::clamp_to_edge, 0},
      {8, 4, 1, TextureKind::two_d, Filter::linear, Wrap::repeat, 0},
      {7, 5, 1, TextureKind::two_d, Filter::linear, Wrap::repeat, 3},
      {7, 5, 3, TextureKind::two_d_array, Filter::linear, Wrap::clamp_to_edge, 1},
      {6, 6, 6, TextureKind::cube, Filter::linear, Wrap::clamp_to_edge, 0},
      {7, 5, 1, TextureKind::two_d, Filter::nearest, Wrap::repeat, 0},
  };
  return textures[kind].view;
}

BufferView test_buffer() {
  static const std::vector<std::uint32_t> words = [] {
    std::vector<std::uint32_t> w(kBufferWords);
    for (int i = 0; i < kBufferWords; ++i) {
      const float x = static_cast<float>(i) * 1.5f - 7;
      std::memcpy(&w[static_cast<std::size_t>(i)], &x, 4);
    }
    w[5] = 0;
    return w;
  }();
  return {reinterpret_cast<std::byte*>(const_cast<std::uint32_t*>(words.data())), words.size() * 4};
}

}  // namespace twinshade::test
