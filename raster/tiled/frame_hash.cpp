// The frame's hash: what "the same frame" means when renderers, thread counts and machines are compared.
#include <bit>
#include <cstring>
#include <span>

#include "base/hash.h"
#include "raster/renderer.h"

namespace twinshade {
namespace {

// NaN compares as a class: its payload is the processor's choice.
void add_floats(Sha256& hash, std::span<const float> values) {
  std::uint32_t block[1024];
  for (std::size_t begin = 0; begin < values.size(); begin += 1024) {
    const std::size_t count = std::min<std::size_t>(1024, values.size() - begin);
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t bits = std::bit_cast<std::uint32_t>(values[begin + i]);
      block[i] = (bits & 0x7fffffffu) > 0x7f800000u ? 0x7fc00000u : bits;
    }
    hash.add(block, count * sizeof(std::uint32_t));
  }
}

}  // namespace

std::string frame_hash(const Frame& frame) {
  static_assert(std::endian::native == std::endian::little, "the hash is over little-endian values");
  Sha256 hash;
  const std::uint32_t size[2] = {frame.width, frame.height};
  hash.add(size, sizeof size);
  hash.add(frame.coverage.data(), frame.coverage.size());
  hash.add(frame.primitive_id.data(), frame.primitive_id.size() * sizeof(std::uint32_t));
  add_floats(hash, frame.depth);
  if (frame.color_scalar == Scalar::f32)
    add_floats(hash, frame.color);
  else
    hash.add(frame.color.data(), frame.color.size() * sizeof(float));
  return hash.hex();
}

}  // namespace twinshade
