#include <bit>
#include <optional>

#include "cpu_shaders/runtime/denormals.h"
#include "raster/tiled/draw.h"

namespace twinshade::tiled {

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

  for (std::uint32_t q = 0; q < padded; ++q) {
    const std::uint32_t coverage = q < count_ ? coverage_[q] : 0;
    for (std::uint32_t i = 0; i < 4; ++i) live_[4 * q + i] = coverage >> i & 1 ? ~0u : 0u;
  }
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
  return depth > 0 ? (depth < 1 ? depth : 1.0f) : 0.0f;  // NaN: 0
}

template <class R>
void Batch::store_as(const R* outputs, const R* inputs, std::uint32_t quad, std::uint32_t mask) const {
  Frame& frame = draw_.frame;
  const std::uint32_t components = draw_.bound.color_components;
  const R* color = outputs + std::size_t(draw_.bound.color_first) * kStride + 4 * quad;
  for (std::uint32_t i = 0; i < 4; ++i) {
    if (!(mask >> i & 1)) continue;
    const std::size_t pixel =
        (quads_[quad].y + std::size_t(i >> 1)) * frame.width + quads_[quad].x + std::size_t(i & 1);
    for (std::uint32_t c = 0; c < 4; ++c) {
      const R value = c < components ? color[std::size_t(c) * kStride + i] : R(0);
      frame.color[4 * pixel + c] = float(value);
      if constexpr (sizeof(R) == sizeof(double)) frame.color64[4 * pixel + c] = value;
    }
    if (!draw_.options.capture_attributes) continue;
    const std::size_t pixels = std::size_t(frame.width) * frame.height;
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

void Batch::store(std::uint32_t quad, std::uint32_t mask) const {
  if (draw_.float64())
    store_as(outputs_.data(), inputs_.data(), quad, mask);
  else
    store_as(reinterpret_cast<const float*>(outputs_.data()), reinterpret_cast<const float*>(inputs_.data()), quad,
             mask);
}

}  // namespace twinshade::tiled
