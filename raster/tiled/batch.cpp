#include <bit>
#include <optional>

#include "cpu_shaders/runtime/denormals.h"
#include "raster/tiled/draw.h"

namespace twinshade::tiled {
const Batch::QuadPixels Batch::kQuadPixels[16] = {
    {{0, 0, 0, 0}, 0}, {{0, 0, 0, 0}, 1}, {{1, 0, 0, 0}, 1}, {{0, 1, 0, 0}, 2}, {{2, 0, 0, 0}, 1}, {{0, 2, 0, 0}, 2},
    {{1, 2, 0, 0}, 2}, {{0, 1, 2, 0}, 3}, {{3, 0, 0, 0}, 1}, {{0, 3, 0, 0}, 2}, {{1, 3, 0, 0}, 2}, {{0, 1, 3, 0}, 3},
    {{2, 3, 0, 0}, 2}, {{0, 2, 3, 0}, 3}, {{1, 2, 3, 0}, 3}, {{0, 1, 2, 3}, 4}};

const std::uint32_t Batch::kLaneMasks[16][4] = {
    {0, 0, 0, 0},     {~0u, 0, 0, 0},     {0, ~0u, 0, 0},     {~0u, ~0u, 0, 0},    {0, 0, ~0u, 0},   {~0u, 0, ~0u, 0},
    {0, ~0u, ~0u, 0}, {~0u, ~0u, ~0u, 0}, {0, 0, 0, ~0u},     {~0u, 0, 0, ~0u},    {0, ~0u, 0, ~0u}, {~0u, ~0u, 0, ~0u},
    {0, 0, ~0u, ~0u}, {~0u, 0, ~0u, ~0u}, {0, ~0u, ~0u, ~0u}, {~0u, ~0u, ~0u, ~0u}};

Batch::Batch(const Draw& draw)
    : draw_(draw),
      center_x_(kStride),
      center_y_(kStride),
      inputs_(std::size_t(kStride) * draw.module.input_components),
      frag_coord_(std::size_t(kStride) * 4),
      outputs_(std::size_t(kStride) * draw.module.output_components),
      frag_depth_(kStride),
      front_facing_(kStride),
      primitive_id_(kStride),
      kept_(kStride) {
  for (const Interpolation how : draw.bound.interpolation) interpolation_.push_back(std::uint8_t(how));
  for (const Scalar scalar : draw.bound.input_scalars) scalars_.push_back(std::uint8_t(scalar));
}

void Batch::begin_tile(std::uint32_t x, std::uint32_t y) {
  tile_x_ = x;
  tile_y_ = y;
}

void Batch::clear() {
  count_ = run_count_ = 0;
  all_live_ = true;
}

void Batch::shade(const LocalPrimitive* primitives, StageClock& clock) {
  // Whole vectors of 16: dead invocations repeat the last one.
  const std::uint32_t padded = (count_ + 15) / 16 * 16;
  for (std::uint32_t k = count_; k < padded; ++k) {
    pixels_[k] = pixels_[count_ - 1];
    live_[k] = 0;
  }

  std::optional<FlushDenormals> flush;
  if (!draw_.float64()) flush.emplace();
  Interpolate interpolate;
  interpolate.pixels = pixels_;
  interpolate.count = padded;
  interpolate.tile_x = tile_x_;
  interpolate.tile_y = tile_y_;
  interpolate.superblocks_log = std::uint32_t(std::countr_zero(draw_.grid.tile_size / kSuperblock));
  interpolate.runs = runs_;
  interpolate.run_count = run_count_;
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

  if (draw_.module.uses_primitive_id)
    for (std::uint32_t r = 0; r < run_count_; ++r)
      std::fill(primitive_id_.data() + runs_[r].first,
                primitive_id_.data() + (r + 1 < run_count_ ? runs_[r + 1].first : padded),
                primitives[runs_[r].local].primitive);
  clock.lap(Stage::interpolate);

  ShadeCall call;
  call.count = padded;
  call.stride = kStride;
  call.inputs = inputs_.data();
  call.frag_coord = frag_coord_.data();
  call.live = live_;
  call.front_facing = front_facing_.data();
  call.primitive_id = primitive_id_.data();
  call.outputs = outputs_.data();
  call.frag_depth = frag_depth_.data();
  call.kept = kept_.data();
  draw_.entry.shade(draw_.bound.data(), call);
  clock.lap(Stage::shade);
}

float Batch::frag_depth(std::uint32_t k) const {
  const float depth = draw_.float64() ? float(frag_depth_[k]) : reinterpret_cast<const float*>(frag_depth_.data())[k];
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
  StoreColors call{};
  for (std::uint32_t c = 0; c < draw_.bound.color_components; ++c)
    call.channels[c] = outputs + std::size_t(draw_.bound.color_first + c) * kStride;
  call.pixels = pixels_;
  call.stored = all_live_ ? nullptr : live_;
  call.count = count_;
  call.color = tile_color;
  draw_.kernels.store_colors(call);
  if (draw_.options.capture_attributes) store_extras(outputs, reinterpret_cast<const float*>(inputs_.data()));
}

// Colours in double, rounded.
void Batch::store_narrowed(float* tile_color) const {
  for (std::uint32_t k = 0; k < count_; ++k) {
    if (live_[k] == 0) continue;
    float* pixel = tile_color + 4 * std::size_t(pixels_[k]);
    for (std::uint32_t c = 0; c < 4; ++c)
      pixel[c] = c < draw_.bound.color_components
                     ? float(outputs_[std::size_t(draw_.bound.color_first + c) * kStride + k])
                     : 0.0f;
  }
}

template <class R>
void Batch::store_extras(const R* outputs, const R* inputs) const {
  Frame& frame = draw_.frame;
  const std::size_t pixels = std::size_t(frame.width) * frame.height;
  // Where the pixels are: as the interpolation found them.
  const R* const center_x = reinterpret_cast<const R*>(center_x_.data());
  const R* const center_y = reinterpret_cast<const R*>(center_y_.data());
  for (std::uint32_t k = 0; k < count_; ++k) {
    if (live_[k] == 0) continue;
    const std::size_t pixel = std::size_t(center_y[k]) * frame.width + std::size_t(center_x[k]);
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
