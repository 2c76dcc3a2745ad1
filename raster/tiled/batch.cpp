#include <array>
#include <bit>
#include <cstring>
#include <optional>

#include "cpu_shaders/runtime/denormals.h"
#include "cpu_shaders/runtime/simd_lanes.h"
#include "raster/tiled/draw.h"

namespace twinshade::tiled {
namespace {

// [m][i]: ~0 where bit i of m is set.
constexpr std::array<std::array<std::uint32_t, 4>, 16> make_lane_masks() {
  std::array<std::array<std::uint32_t, 4>, 16> masks{};
  for (std::size_t m = 0; m < 16; ++m)
    for (std::size_t i = 0; i < 4; ++i) masks[m][i] = m >> i & 1 ? ~0u : 0u;
  return masks;
}
constexpr auto kLaneMasks = make_lane_masks();

}  // namespace

Batch::Batch(const Draw& draw)
    : draw_(draw),
      center_x_(kStride),
      center_y_(kStride),
      inputs_(std::size_t(kStride) * draw.module.input_components),
      frag_coord_(std::size_t(kStride) * 4),
      outputs_(std::size_t(kStride) * draw.module.output_components),
      frag_depth_(kStride),
      live_(kStride),
      front_facing_(kStride),
      primitive_id_(kStride),
      kept_(kStride) {
  for (const Interpolation how : draw.bound.interpolation) interpolation_.push_back(std::uint8_t(how));
  for (const Scalar scalar : draw.bound.input_scalars) scalars_.push_back(std::uint8_t(scalar));
}

void Batch::add(ShadeQuad quad, std::uint32_t coverage) {
  quads_[count_] = quad;
  coverage_[count_] = coverage;
  ++count_;
}

void Batch::shade(const LocalPrimitive* primitives, StageClock& clock) {
  // Whole vectors of 16: dead quads repeat the last one.
  const std::uint32_t padded = (count_ + 3) / 4 * 4;
  for (std::uint32_t q = count_; q < padded; ++q) quads_[q] = quads_[count_ - 1];

  std::optional<FlushDenormals> flush;
  if (!draw_.float64()) flush.emplace();
  InterpolateQuads interpolate;
  interpolate.quads = quads_;
  interpolate.count = padded;
  interpolate.primitives = primitives;
  interpolate.vertices = &draw_.vertices;
  interpolate.interpolation = interpolation_.data();
  interpolate.scalars = scalars_.data();
  interpolate.native = draw_.native();
  interpolate.stride = kStride;
  interpolate.center_x = center_x_.data();
  interpolate.center_y = center_y_.data();
  interpolate.inputs = inputs_.data();
  interpolate.frag_coord = draw_.module.uses_frag_coord ? frag_coord_.data() : nullptr;
  interpolate.front_facing = draw_.module.uses_front_facing ? front_facing_.data() : nullptr;
  draw_.kernels.interpolate(interpolate);

  for (std::uint32_t q = 0; q < padded; ++q)
    std::memcpy(&live_[4 * q], kLaneMasks[q < count_ ? coverage_[q] : 0].data(), 16);
  if (draw_.module.uses_primitive_id)
    for (std::uint32_t q = 0; q < padded; ++q)
      for (std::uint32_t i = 0; i < 4; ++i) primitive_id_[4 * q + i] = primitives[quads_[q].local].primitive;
  clock.lap(Stage::interpolate);

  ShadeCall call;
  call.count = 4 * padded;
  call.stride = kStride;
  call.inputs = inputs_.data();
  call.frag_coord = frag_coord_.data();
  call.live = live_.data();
  call.front_facing = front_facing_.data();
  call.primitive_id = primitive_id_.data();
  call.outputs = outputs_.data();
  call.frag_depth = frag_depth_.data();
  call.kept = kept_.data();
  draw_.entry.shade(draw_.bound.data(), call);
  clock.lap(Stage::shade);
}

std::uint32_t Batch::kept(std::uint32_t quad) const {
  std::uint32_t mask = 0;
  for (std::uint32_t i = 0; i < 4; ++i) mask |= (kept_[4 * quad + i] & 1u) << i;
  return mask & coverage_[quad];
}

float Batch::frag_depth(std::uint32_t quad, std::uint32_t pixel) const {
  const std::size_t i = 4 * std::size_t(quad) + pixel;
  const float depth = draw_.float64() ? float(frag_depth_[i]) : reinterpret_cast<const float*>(frag_depth_.data())[i];
  return depth < 1 ? (depth > 0 ? depth : 0.0f) : 1.0f;  // NaN: 1, which no depth is greater than
}

namespace {

using F4 = Simd<float, 4>;

// Rows become columns.
void transpose(F4 (&m)[4]) {
  const auto a = __builtin_shufflevector(m[0].v, m[1].v, 0, 4, 1, 5),
             b = __builtin_shufflevector(m[0].v, m[1].v, 2, 6, 3, 7);
  const auto c = __builtin_shufflevector(m[2].v, m[3].v, 0, 4, 1, 5),
             d = __builtin_shufflevector(m[2].v, m[3].v, 2, 6, 3, 7);
  m[0].v = __builtin_shufflevector(a, c, 0, 1, 4, 5);
  m[1].v = __builtin_shufflevector(a, c, 2, 3, 6, 7);
  m[2].v = __builtin_shufflevector(b, d, 0, 1, 4, 5);
  m[3].v = __builtin_shufflevector(b, d, 2, 3, 6, 7);
}

F4 load4(const float* from) { return F4::load(from); }
F4 load4(const double* from) {
  const float narrowed[4] = {float(from[0]), float(from[1]), float(from[2]), float(from[3])};
  return F4::load(narrowed);
}

}  // namespace

void Batch::store(std::uint32_t quad, std::uint32_t mask, float* color) const {
  const bool float64 = draw_.float64();
  const double* doubles = outputs_.data();
  const float* floats = reinterpret_cast<const float*>(doubles);
  F4 pixels[4];
  for (std::uint32_t c = 0; c < 4; ++c) {
    const std::size_t at = std::size_t(draw_.bound.color_first + c) * kStride + 4 * quad;
    if (c >= draw_.bound.color_components)
      pixels[c] = F4(0.0f);
    else
      pixels[c] = float64 ? load4(doubles + at) : load4(floats + at);
  }
  transpose(pixels);
  for (std::uint32_t i = 0; i < 4; ++i)
    if (mask >> i & 1) pixels[i].store(color + 4 * i);

  if (float64)
    store_extras(doubles, inputs_.data(), quad, mask);
  else if (draw_.options.capture_attributes)
    store_extras(floats, reinterpret_cast<const float*>(inputs_.data()), quad, mask);
}

template <class R>
void Batch::store_extras(const R* outputs, const R* inputs, std::uint32_t quad, std::uint32_t mask) const {
  Frame& frame = draw_.frame;
  const std::size_t pixels = std::size_t(frame.width) * frame.height;
  for (std::uint32_t i = 0; i < 4; ++i) {
    if (!(mask >> i & 1)) continue;
    const std::size_t pixel =
        (quads_[quad].y + std::size_t(i >> 1)) * frame.width + quads_[quad].x + std::size_t(i & 1);
    if constexpr (sizeof(R) == sizeof(double))
      for (std::uint32_t c = 0; c < draw_.bound.color_components; ++c)
        frame.color64[4 * pixel + c] = outputs[std::size_t(draw_.bound.color_first + c) * kStride + 4 * quad + i];
    if (!draw_.options.capture_attributes) continue;
    for (std::uint32_t c = 0; c < draw_.bound.input_components; ++c) {
      const R value = inputs[std::size_t(c) * kStride + 4 * quad + i];
      float stored = float(value);
      if constexpr (sizeof(R) == sizeof(double)) {  // integers came as values, and leave by bit pattern
        if (draw_.bound.input_scalars[c] == Scalar::i32)
          stored = std::bit_cast<float>(std::int32_t(value));
        else if (draw_.bound.input_scalars[c] != Scalar::f32)
          stored = std::bit_cast<float>(std::uint32_t(value));
      }
      frame.attributes[c * pixels + pixel] = stored;
    }
  }
}

}  // namespace twinshade::tiled
