#include <algorithm>

#include "raster/tiled/draw.h"

namespace twinshade::tiled {

TileWorker::TileWorker(const Draw& draw)
    : draw_(draw),
      batch_(draw),
      depth_(std::size_t(draw.grid.tile_size) * draw.grid.tile_size),
      visible_(std::size_t(draw.grid.tile_size) * draw.grid.tile_size),
      color_((std::size_t(draw.grid.tile_size) * draw.grid.tile_size + 1) * 4),
      primitive_id_(std::size_t(draw.grid.tile_size) * draw.grid.tile_size) {
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
  batch_.begin_tile(tile_.x, tile_.y);
  gather_triangles(tile);
  if (tile_.count > 0) {
    if (draw_.in_order())
      shade_in_order();
    else
      shade_visible();
    ++tiles_shaded_;
  } else {
    std::fill_n(color_.data(), 4 * pixels, 0.0f);
    std::fill_n(primitive_id_.data(), pixels, kNoPrimitive);
  }
  store_tile();
  clock_.lap(Stage::store);
}

// The tile's bin, and one LocalPrimitive for what counts as one when pixels are shaded.
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

}  // namespace twinshade::tiled
