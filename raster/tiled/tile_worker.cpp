#include <algorithm>

#include "raster/tiled/draw.h"

namespace twinshade::tiled {

TileWorker::TileWorker(const Draw& draw)
    : draw_(draw),
      batch_(draw),
      depth_(std::size_t(draw.grid.tile_size) * draw.grid.tile_size),
      visible_(std::size_t(draw.grid.tile_size) * draw.grid.tile_size) {
  tile_.vertices = &draw.vertices;
  tile_.size = draw.grid.tile_size;
  tile_.frame_width = draw.grid.frame_width;
  tile_.frame_height = draw.grid.frame_height;
  tile_.depth = depth_.data();
  tile_.visible = visible_.data();
}

void TileWorker::draw_tile(std::uint32_t tile) {
  clock_.start();
  tile_.x = tile % draw_.grid.columns * tile_.size;
  tile_.y = tile / draw_.grid.columns * tile_.size;
  const std::size_t pixels = std::size_t(tile_.size) * tile_.size;
  std::fill_n(tile_.depth, pixels, 1.0f);
  std::fill_n(tile_.visible, pixels, kNotVisible);
  gather_triangles(tile);
  if (tile_.count > 0) {
    if (draw_.in_order())
      shade_in_order();
    else
      shade_visible();
    ++tiles_shaded_;
  }
  store_tile();
  clock_.lap(Stage::store);
}

// The tile's bin, and one LocalPrimitive for what counts as one when quads are formed.
void TileWorker::gather_triangles(std::uint32_t tile) {
  triangles_.clear();
  locals_.clear();
  primitives_.clear();
  const Geometry& geometry = draw_.geometry;
  for (std::uint32_t i = geometry.bin_begin[tile]; i < geometry.bin_begin[tile + 1]; ++i) {
    const TriangleRef ref = geometry.bins[i];
    const TriangleChunk& chunk = geometry.chunks[ref.chunk()];
    const RasterTriangle& triangle = chunk.triangles[ref.index()];
    triangles_.push_back(&triangle);
    if (draw_.native())
      primitives_.push_back(
          {triangle.primitive, &chunk.native[ref.index()], chunk.clipped_inputs.data(), triangle.front_facing});
    else if (primitives_.empty() || primitives_.back().primitive != triangle.primitive)
      primitives_.push_back({triangle.primitive, nullptr, nullptr, 0});
    locals_.push_back(std::uint32_t(primitives_.size() - 1));
  }
  tile_.triangles = triangles_.data();
  tile_.locals = locals_.data();
  tile_.count = std::uint32_t(triangles_.size());
  tile_.primitives = primitives_.data();
}

ShadeQuad TileWorker::place(std::uint32_t tile_quad, std::uint32_t local) const {
  const std::uint32_t superblocks = tile_.size / kSuperblock;
  const std::uint32_t superblock = tile_quad / 64, block = tile_quad / 4 % 16, quad = tile_quad % 4;
  const std::uint32_t x = superblock % superblocks * 16 + block % 4 * 4 + quad % 2 * 2;
  const std::uint32_t y = superblock / superblocks * 16 + block / 4 * 4 + quad / 2 * 2;
  return {std::uint16_t(tile_.x + x), std::uint16_t(tile_.y + y), local};
}

// From the tile's order of pixels to the frame's rows; clears what nothing was drawn on.
void TileWorker::store_tile() {
  Frame& frame = draw_.frame;
  const std::uint32_t quads = tile_.size * tile_.size / 4;
  for (std::uint32_t q = 0; q < quads; ++q) {
    const ShadeQuad at = place(q, 0);
    for (std::uint32_t i = 0; i < 4; ++i) {
      const std::uint32_t x = at.x + (i & 1), y = at.y + (i >> 1);
      if (x >= frame.width || y >= frame.height) continue;
      const std::size_t pixel = std::size_t(y) * frame.width + x;
      const std::uint32_t local = tile_.visible[4 * q + i];
      frame.depth[pixel] = tile_.depth[4 * q + i];
      frame.coverage[pixel] = local != kNotVisible;
      frame.primitive_id[pixel] = local != kNotVisible ? primitives_[local].primitive : kNoPrimitive;
      if (local == kNotVisible) {
        std::fill_n(&frame.color[4 * pixel], 4, 0.0f);
        if (draw_.float64()) std::fill_n(&frame.color64[4 * pixel], 4, 0.0);
      }
    }
  }
}

}  // namespace twinshade::tiled
