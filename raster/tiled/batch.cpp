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

void Batch::add(ShadeQuad quad, std::uint32_t tile_quad, std::uint32_t coverage) {
  quads_[count_] = quad;
  tile_quads_[count_] = tile_quad;
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

void Batch::store(float* tile_color) const {
  const bool float64 = draw_.float64();
  if (float64) {
    store_narrowed(tile_color);
    store_extras(outputs_.data(), inputs_.data());
    return;
  }
  const float* outputs = reinterpret_cast<const float*>(outputs_.data());
  StoreQuads call{};
  for (std::uint32_t c = 0; c < draw_.bound.color_components; ++c)
    call.channels[c] = outputs + std::size_t(draw_.bound.color_first + c) * kStride;
  call.tile_quads = tile_quads_;
  call.coverage = coverage_;
  call.count = count_;
  call.color = tile_color;
  draw_.kernels.store_quads(call);
  if (draw_.options.capture_attributes) store_extras(outputs, reinterpret_cast<const float*>(inputs_.data()));
}

// Colours in double, rounded.
void Batch::store_narrowed(float* tile_color) const {
  for (std::uint32_t q = 0; q < count_; ++q)
    for (std::uint32_t i = 0; i < 4; ++i) {
      if (!(coverage_[q] >> i & 1)) continue;
      float* pixel = tile_color + (4 * std::size_t(tile_quads_[q]) + i) * 4;
      for (std::uint32_t c = 0; c < 4; ++c)
        pixel[c] = c < draw_.bound.color_components
                       ? float(outputs_[std::size_t(draw_.bound.color_first + c) * kStride + 4 * q + i])
                       : 0.0f;
    }
}

template <class R>
void Batch::store_extras(const R* outputs, const R* inputs) const {
  Frame& frame = draw_.frame;
  const std::size_t pixels = std::size_t(frame.width) * frame.height;
  for (std::uint32_t k = 0; k < 4 * count_; ++k) {
    const std::uint32_t quad = k / 4, i = k % 4;
    if (!(coverage_[quad] >> i & 1)) continue;
    const std::size_t pixel =
        (quads_[quad].y + std::size_t(i >> 1)) * frame.width + quads_[quad].x + std::size_t(i & 1);
    if constexpr (sizeof(R) == sizeof(double))
      for (std::uint32_t c = 0; c < draw_.bound.color_components; ++c)
        frame.color64[4 * pixel + c] = outputs[std::size_t(draw_.bound.color_first + c) * kStride + k];
    if (!draw_.options.capture_attributes) continue;
    for (std::uint32_t c = 0; c < draw_.bound.input_components; ++c) {
      const R value = inputs[std::size_t(c) * kStride + k];
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
