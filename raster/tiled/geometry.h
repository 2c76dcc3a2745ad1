// From clip-space vertices to triangles in bins: everything that happens once per primitive.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "raster/tiled/bind.h"
#include "raster/tiled/kernels.h"
#include "raster/tiled/triangle.h"

namespace twinshade::tiled {

struct TileGrid {
  std::uint32_t frame_width, frame_height, tile_size, columns, rows;
  std::uint32_t count() const { return columns * rows; }
};
TileGrid make_grid(std::uint32_t frame_width, std::uint32_t frame_height, int tile_size);

// Primitives are worked on in chunks, each by one thread; chunks in order hold primitives in order.
struct TriangleChunk {
  struct Reference {
    std::uint32_t tile, triangle;  // index into triangles
  };
  std::vector<RasterTriangle>
      triangles;                       // the first ones, as many as references name: room is kept from frame to frame
  std::vector<NativeTriangle> native;  // as triangles, or empty with exact attributes
  std::vector<float> clipped_inputs;   // rows of BoundDraw::input_components
  std::vector<Reference> references;
  std::vector<std::uint32_t> tile_counts;  // references to each tile, then where this chunk's begin in Geometry::bins
};

// A triangle, as bins hold it: chunk in the upper bits, index in the lower ones.
struct TriangleRef {
  static constexpr int kIndexBits = 26;
  std::uint32_t packed;
  std::uint32_t chunk() const { return packed >> kIndexBits; }
  std::uint32_t index() const { return packed & ((1u << kIndexBits) - 1); }
};

// Kept between frames so that drawing again allocates nothing.
struct Geometry {
  std::vector<WindowVertex> vertices;
  std::vector<WindowPosition> positions;  // native attributes only
  std::vector<TriangleChunk> chunks;
  std::vector<TriangleRef> bins;         // of all tiles, in primitive order within each
  std::vector<std::uint32_t> bin_begin;  // of each tile, and the end of the last
};

// In parallel, with denormals flushed.
void transform_vertices(const Bundle& bundle, AttributeMode mode, const Kernels& kernels, Geometry& geometry);
void set_up_and_bin(const Bundle& bundle, const BoundDraw& draw, AttributeMode mode, const Kernels& kernels,
                    const TileGrid& grid, Geometry& geometry);

}  // namespace twinshade::tiled
