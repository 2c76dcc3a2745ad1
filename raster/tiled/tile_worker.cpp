#include <algorithm>
#include <cstring>

#include "raster/tiled/draw.h"

namespace twinshade::tiled {
namespace {

// By lines of memory: g++ at -O2 fills one number at a time, which is a fiftieth of a cheap frame.
void clear_depth(float* depth, std::size_t pixels) {
  constexpr std::size_t kAtOnce = 16;
  alignas(64) float ones[kAtOnce];
  std::fill_n(ones, kAtOnce, 1.0f);
  for (std::size_t i = 0; i < pixels; i += kAtOnce) std::memcpy(depth + i, ones, sizeof ones);
}

}  // namespace

TileWorker::TileWorker(const Draw& draw)
    : draw_(draw),
      batch_(draw),
      depth_(std::size_t(draw.grid.tile_size) * draw.grid.tile_size),
      farthest_(kFarthestRoom),
      visible_(std::size_t(draw.grid.tile_size) * draw.grid.tile_size),
      color_((std::size_t(draw.grid.tile_size) * draw.grid.tile_size + 1) * 4),
      primitive_id_(std::size_t(draw.grid.tile_size) * draw.grid.tile_size) {
  tile_.vertices = &draw.vertices;
  tile_.size = draw.grid.tile_size;
  tile_.frame_width = draw.grid.frame_width;
  tile_.frame_height = draw.grid.frame_height;
  tile_.depth = depth_.data();
  tile_.visible = visible_.data();
  tile_.farthest = farthest_.data();
}

void TileWorker::draw_tile(std::uint32_t tile) {
  ticks_.start();
  tile_.x = tile % draw_.grid.columns * tile_.size;
  tile_.y = tile / draw_.grid.columns * tile_.size;
  const std::size_t pixels = std::size_t(tile_.size) * tile_.size;
  clear_depth(tile_.depth, pixels);
  std::fill_n(tile_.visible, pixels, kNotVisible);
  std::fill_n(tile_.farthest, kFarthestRoom, 1.0f);
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
  ticks_.lap(Stage::store);
}

// The tile's bin, and one LocalPrimitive for what counts as one when pixels are shaded. Triangles are asked for before
// any is read: they lie where their chunks have them, not tile by tile.
void TileWorker::gather_triangles(std::uint32_t tile) {
  const Geometry& geometry = draw_.geometry;
  const TriangleRef* const refs = geometry.bins.data() + geometry.bin_begin[tile];
  const std::uint32_t count = geometry.bin_begin[tile + 1] - geometry.bin_begin[tile];
  if (count > triangles_.size()) {
    triangles_.resize(count);
    locals_.resize(count);
    primitives_.resize(count);
  }
  const RasterTriangle** const triangles = triangles_.data();
  for (std::uint32_t i = 0; i < count; ++i) {
    triangles[i] = &geometry.chunks[refs[i].chunk()].triangles[refs[i].index()];
    __builtin_prefetch(triangles[i]);
  }
  const bool native = draw_.native();
  std::uint32_t* const locals = locals_.data();
  LocalPrimitive* next = primitives_.data();
  for (std::uint32_t i = 0; i < count; ++i) {
    const RasterTriangle& triangle = *triangles[i];
    if (native || i == 0 || next[-1].primitive != triangle.primitive) {
      // Field by field: clang++ puts a struct together on the stack, and the copy waits for it.
      next->primitive = triangle.primitive;
      if (native) {
        const TriangleChunk& chunk = geometry.chunks[refs[i].chunk()];
        next->native = &chunk.native[refs[i].index()];
        next->clipped_inputs = chunk.clipped_inputs.data();
      }
      ++next;
    }
    locals[i] = std::uint32_t(next - primitives_.data()) - 1;
  }
  tile_.triangles = triangles;
  tile_.locals = locals;
  tile_.count = count;
  tile_.primitives = primitives_.data();
}

// Groups by what is nearest of each: what they cover hides others, which cost little then. Of a few neighbours each,
// lest vertices be read in no order at all.
void TileWorker::sort_groups() {
  groups_.clear();
  for (std::uint32_t first = 0; first < tile_.count; first += kTrianglesTogether) {
    float nearest = 1;
    for (std::uint32_t i = first, end = group_end(first); i < end; ++i)
      nearest = std::min(nearest, tile_.triangles[i]->nearest);
    groups_.push_back({nearest, first});
  }
  std::sort(groups_.begin(), groups_.end(),
            [](const TriangleGroup& a, const TriangleGroup& b) { return a.nearest < b.nearest; });
  tile_.groups = groups_.data();
  tile_.group_count = std::uint32_t(groups_.size());
}

}  // namespace twinshade::tiled
