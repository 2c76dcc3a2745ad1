// What is the same for all tiles of a draw, and what each worker thread has of its own.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "raster/tiled/aligned.h"
#include "raster/tiled/geometry.h"
#include "raster/tiled/kernels.h"
#include "raster/tiled/stages.h"

namespace twinshade::tiled {

struct Draw {
  const Bundle& bundle;
  const ShaderModule& module;
  const DrawOptions& options;
  const BoundDraw& bound;
  const ShaderEntry& entry;
  const Kernels& kernels;
  TileGrid grid;
  VertexData vertices;
  Geometry& geometry;
  Frame& frame;

  bool native() const { return options.attributes == AttributeMode::native; }
  bool float64() const { return entry.number == Number::float64; }
  // Shaders that decide themselves what becomes of a fragment, or whose running can be seen.
  bool in_order() const { return module.discards || module.writes_depth || module.has_side_effects; }
};

// Invocations are shaded this many at a time, whatever the size of triangles.
inline constexpr std::uint32_t kBatchSize = 256;

// Invocations going through interpolation and the shader together.
class Batch {
 public:
  explicit Batch(const Draw& draw);

  // The lower left pixel, in the frame, of the tile that pixels are of from now on.
  void begin_tile(std::uint32_t x, std::uint32_t y);

  std::uint32_t count() const { return count_; }
  // Shade it before more is added.
  bool full() const { return count_ >= kBatchSize; }
  // All four pixels of a quad. quad: index in the tile's memory / 4; coverage: bit i for its pixel i.
  void add_quad(std::uint32_t local, std::uint32_t quad, std::uint32_t coverage);
  // The covered pixels alone, of blocks until it is full. Returns how many blocks it took. A batch has invocations of
  // one kind only.
  std::size_t add_covered(const VisibleBlock* blocks, std::size_t block_count);

  // Fills inputs, runs the shader on kBatchSize invocations or all that there are, stores nothing yet. Pads with dead
  // ones to whole vectors first.
  void shade(const LocalPrimitive* primitives, StageClock& clock);
  // Keeps what was added beyond kBatchSize.
  void clear();

  // What became of an invocation: whether it was covered and the shader kept it.
  bool kept(std::uint32_t invocation) const { return kept_[invocation] != 0; }
  float frag_depth(std::uint32_t invocation) const;
  // It is not to be stored.
  void drop(std::uint32_t invocation) { live_[invocation] = 0; }
  // Colours of covered pixels to the tile's RGBA pixels; attributes and unrounded colours, where asked for, to the
  // frame.
  void store(float* tile_color) const;

 private:
  void store_narrowed(float* tile_color) const;
  template <class R>
  void store_extras(const R* outputs, const R* inputs) const;

  static constexpr std::uint32_t kStride = kBatchSize + 32;  // a block more, and the words that are written past it

  std::uint32_t end_of_run(std::uint32_t run, std::uint32_t count) const {
    return run + 1 < run_count_ ? std::min(runs_[run + 1].first, count) : count;
  }
  std::uint32_t shaded() const { return std::min(count_, kBatchSize); }

  const Draw& draw_;
  std::uint32_t tile_x_ = 0, tile_y_ = 0;
  std::uint32_t count_ = 0, run_count_ = 0;
  bool quads_ = false;                                         // live_ says which are covered; else all are
  alignas(64) std::uint32_t pixels_[kStride], live_[kStride];  // of each invocation
  ShadeRun runs_[kStride];
  std::vector<std::uint8_t> interpolation_, scalars_;
  // Doubles for all numbers: floats use the first half.
  AlignedArray<double> center_x_, center_y_, inputs_, frag_coord_, outputs_, frag_depth_;
  AlignedArray<std::uint32_t> front_facing_, primitive_id_, kept_;
};

// One worker's tile.
class TileWorker {
 public:
  explicit TileWorker(const Draw& draw);
  void draw_tile(std::uint32_t tile);
  StageClock& clock() { return clock_; }
  std::uint32_t tiles_shaded() const { return tiles_shaded_; }

 private:
  struct BatchQuad {
    CoveredQuad quad;
    std::uint32_t local;
  };

  void gather_triangles(std::uint32_t tile);
  void shade_visible();  // shade_pass.cpp
  void collect_visible();
  void shade_batch();
  void shade_in_order();  // in_order_pass.cpp
  void resolve_in_order();
  void name_primitives();
  void store_tile();  // store_tile.cpp
  void store_superblock(std::uint32_t first, std::uint32_t x, std::uint32_t y);
  void store_superblock_by_pixels(std::uint32_t first, std::uint32_t x, std::uint32_t y);

  const Draw& draw_;
  Batch batch_;
  StageClock clock_;
  std::uint32_t tiles_shaded_ = 0;

  CoverTile tile_{};
  AlignedArray<float> depth_;
  AlignedArray<std::uint32_t> visible_;
  // Of the tile's pixels in memory order, when shading is done; clear where nothing is visible.
  AlignedArray<float> color_;                 // RGBA
  AlignedArray<std::uint32_t> primitive_id_;  // if DrawOptions::visibility
  std::vector<const RasterTriangle*> triangles_;
  std::vector<std::uint32_t> locals_;
  std::vector<LocalPrimitive> primitives_;

  std::vector<VisibleBlock> found_, sorted_;  // shade_pass.cpp
  std::vector<std::uint32_t> place_of_local_;
  std::vector<CoveredQuad> covered_;  // in_order_pass.cpp
  std::vector<BatchQuad> batch_quads_;
};

}  // namespace twinshade::tiled
