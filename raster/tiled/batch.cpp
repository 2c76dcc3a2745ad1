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

std::size_t Batch::add(const VisibleBlock* blocks, std::size_t block_count, const float* depths) {
  AddCovered call{blocks, block_count, kBatchSize, pixels_, live_, runs_, depths, depths_, count_, run_count_};
  const Kernels& kernels = draw_.kernels;
  const std::size_t taken = quads() ? kernels.add_quads(call) : kernels.add_covered(call);
  count_ = call.count;
  run_count_ = call.run_count;
  return taken;
}

void Batch::clear() {
  const std::uint32_t first = shaded(), left = count_ - first;
  std::copy_n(pixels_ + first, left, pixels_);
  std::copy_n(live_ + first, left, live_);
  std::copy_n(depths_ + first, left, depths_);
  std::uint32_t run = run_count_;
  while (run > 0 && end_of_run(run - 1, count_) > first) --run;
  run_count_ -= run;
  for (std::uint32_t r = 0; r < run_count_; ++r)
    runs_[r] = {runs_[run + r].local, runs_[run + r].first > first ? runs_[run + r].first - first : 0};
  count_ = left;
}

void Batch::shade(const LocalPrimitive* primitives, StageTicks& ticks) {
  // Whole vectors of 16: dead invocations repeat the last one.
  const std::uint32_t count = shaded(), padded = (count + 15) / 16 * 16;
  if (!quads()) std::fill_n(live_, count, ~0u);
  for (std::uint32_t k = count; k < padded; ++k) {
    pixels_[k] = pixels_[count - 1];
    live_[k] = 0;
  }
  std::uint32_t run_count = run_count_;
  while (runs_[run_count - 1].first >= count) --run_count;

  std::optional<FlushDenormals> flush;
  if (!draw_.float64()) flush.emplace();
  Interpolate interpolate;
  interpolate.pixels = pixels_;
  interpolate.count = padded;
  interpolate.tile_x = tile_x_;
  interpolate.tile_y = tile_y_;
  interpolate.superblocks_log = std::uint32_t(std::countr_zero(draw_.grid.tile_size / kSuperblock));
  interpolate.runs = runs_;
  interpolate.run_count = run_count;
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
    for (std::uint32_t r = 0; r < run_count; ++r)
      std::fill(primitive_id_.data() + runs_[r].first, primitive_id_.data() + end_of_run(r, padded),
                primitives[runs_[r].local].primitive);
  ticks.lap(Stage::interpolate);

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
  call.ahead = draw_.bound.ahead.data();
  call.ahead_count = std::uint32_t(draw_.bound.ahead.size());
  draw_.entry.shade(draw_.bound.data(), call);
  ticks.lap(Stage::shade);
}

float Batch::frag_depth(std::uint32_t k) const {
  const float depth = draw_.float64() ? float(frag_depth_[k]) : reinterpret_cast<const float*>(frag_depth_.data())[k];
  return depth < 1 ? (depth > 0 ? depth : 0.0f) : 1.0f;  // NaN: 1, which no depth is greater than
}

// Without branches, which clang++ makes of selections: which ones are kept cannot be predicted. Depths are not
// negative, so their bits compare as they do.
template <bool writes_depth>
void Batch::test_depth_of(float* tile_depth, std::uint32_t* tile_visible) {
  const std::uint32_t count = shaded();
  for (std::uint32_t r = 0; r < run_count_ && runs_[r].first < count; ++r) {
    const std::uint32_t local = runs_[r].local;
    for (std::uint32_t k = runs_[r].first, end = std::min(end_of_run(r, count), count); k < end; ++k) {
      const std::uint32_t pixel = pixels_[k];
      const auto depth = std::bit_cast<std::uint32_t>(writes_depth ? frag_depth(k) : depths_[k]);
      const auto before = std::bit_cast<std::uint32_t>(tile_depth[pixel]);
      // Of primitives that are as deep the first one stays; kNotVisible is -1, before all of them.
      const std::uint32_t is_first = std::int32_t(local) < std::int32_t(tile_visible[pixel]);
      const std::uint32_t takes = 0u - std::uint32_t((kept_[k] != 0) & (depth < before + is_first));
      tile_depth[pixel] = std::bit_cast<float>((depth & takes) | (before & ~takes));
      tile_visible[pixel] = (local & takes) | (tile_visible[pixel] & ~takes);
      live_[k] = takes;
    }
  }
}

void Batch::test_depth(float* tile_depth, std::uint32_t* tile_visible) {
  if (draw_.module.writes_depth)
    test_depth_of<true>(tile_depth, tile_visible);
  else
    test_depth_of<false>(tile_depth, tile_visible);
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
  std::uint32_t pixels[kBatchSize];
  if (quads() || draw_.in_order()) {  // those that are not stored go to a pixel after the tile's: no branches
    const std::uint32_t spare = draw_.grid.tile_size * draw_.grid.tile_size;
    for (std::uint32_t k = 0; k < shaded(); ++k) pixels[k] = (pixels_[k] & live_[k]) | (spare & ~live_[k]);
    call.pixels = pixels;
  }
  call.count = shaded();
  call.color = tile_color;
  draw_.kernels.store_colors(call);
  if (draw_.options.capture_attributes) store_extras(outputs, reinterpret_cast<const float*>(inputs_.data()));
}

// Colours in double, rounded.
void Batch::store_narrowed(float* tile_color) const {
  for (std::uint32_t k = 0; k < shaded(); ++k) {
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
  for (std::uint32_t k = 0; k < shaded(); ++k) {
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
