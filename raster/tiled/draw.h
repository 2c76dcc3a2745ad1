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
  // Shaders that tell pixels that are covered and hidden from those that are not covered.
  bool tells_helpers() const { return module.uses_helper_invocation && module.uses_derivatives; }
  // Shaders that decide themselves what becomes of a fragment, or whose running can be seen.
  bool in_order() const { return module.discards || module.writes_depth || module.has_side_effects || tells_helpers(); }
};

// Invocations are shaded this many at a time, whatever the size of triangles.
inline constexpr std::uint32_t kBatchSize = 512;

// Invocations going through interpolation and the shader together.
class Batch {
 public:
  explicit Batch(const Draw& draw);

  // The lower left pixel, in the frame, of the tile that pixels are of from now on.
  void begin_tile(std::uint32_t x, std::uint32_t y);

  std::uint32_t count() const { return count_; }
  // Shade it before more is added.
  bool full() const { return count_ >= kBatchSize; }
  // The covered pixels of blocks until it is full; where the shader has derivatives, all four of each quad that has
  // some. depths: 16 a block, where test_depth follows. Returns how many blocks it took.
  std::size_t add(const VisibleBlock* blocks, std::size_t block_count, const float* depths = nullptr);

  // Fills inputs, runs the shader on kBatchSize invocations or all that there are, stores nothing yet. Pads with dead
  // ones to whole vectors first.
  void shade(const LocalPrimitive* primitives, StageTicks& ticks);
  // Keeps what was added beyond kBatchSize.
  void clear();

  // Of shaded invocations, in order, those that the shader kept and that are nearer than the tile's depth, or as near
  // and of an earlier LocalPrimitive, become what the tile shows; the others are not stored.
  void test_depth(float* tile_depth, std::uint32_t* tile_visible);
  // Colours of covered pixels to the tile's RGBA pixels; attributes and unrounded colours, where asked for, to the
  // frame.
  void store(float* tile_color) const;

 private:
  float frag_depth(std::uint32_t invocation) const;
  template <bool writes_depth>
  void test_depth_of(float* tile_depth, std::uint32_t* tile_visible);
  void store_narrowed(float* tile_color) const;
  template <class R>
  void store_extras(const R* outputs, const R* inputs) const;

  static constexpr std::uint32_t kStride = kBatchSize + 32;  // a block more, and the words that are written past it

  bool quads() const { return draw_.module.uses_derivatives; }  // live_ says which are covered; else all are
  std::uint32_t end_of_run(std::uint32_t run, std::uint32_t count) const {
    return run + 1 < run_count_ ? std::min(runs_[run + 1].first, count) : count;
  }
  std::uint32_t shaded() const { return std::min(count_, kBatchSize); }

  const Draw& draw_;
  std::uint32_t tile_x_ = 0, tile_y_ = 0;
  std::uint32_t count_ = 0, run_count_ = 0;
  alignas(64) std::uint32_t pixels_[kStride], live_[kStride];  // of each invocation
  alignas(64) float depths_[kStride];                          // of each, where test_depth follows
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
  StageTicks& ticks() { return ticks_; }
  std::uint32_t tiles_shaded() const { return tiles_shaded_; }

 private:
  void gather_triangles(std::uint32_t tile);
  void sort_groups();
  std::uint32_t group_end(std::uint32_t first) const { return std::min(tile_.count, first + kTrianglesTogether); }
  void shade_visible();  // shade_pass.cpp
  void shade_batch();
  void shade_in_order();  // in_order_pass.cpp
  void resolve_in_order();
  void name_primitives();
  void store_tile();  // store_tile.cpp
  void store_superblock(std::uint32_t first, std::uint32_t x, std::uint32_t y);
  void store_superblock_by_pixels(std::uint32_t first, std::uint32_t x, std::uint32_t y);

  const Draw& draw_;
  Batch batch_;
  StageTicks ticks_;
  std::uint32_t tiles_shaded_ = 0;

  CoverTile tile_{};
  AlignedArray<float> depth_;
  AlignedArray<float> farthest_;
  AlignedArray<std::uint32_t> visible_;  // triangles; in primitive order (in_order_pass.cpp) LocalPrimitives
  // Of the tile's pixels in memory order, when shading is done; clear where nothing is visible.
  AlignedArray<float> color_;                 // RGBA; room for a pixel more, for what is not stored
  AlignedArray<std::uint32_t> primitive_id_;  // if DrawOptions::visibility
  // Room for as many as the fullest tile so far had triangles.
  std::vector<const RasterTriangle*> triangles_;
  std::vector<std::uint32_t> locals_;
  std::vector<LocalPrimitive> primitives_;
  std::vector<TriangleGroup> groups_;  // where the order of triangles does not count

  std::vector<VisibleBlock> blocks_;  // of all triangles (shade_pass.cpp), or of one (in_order_pass.cpp)
  std::vector<float> block_depths_;   // in_order_pass.cpp
};

}  // namespace twinshade::tiled
