// The loops over vertices, triangles and pixels, compiled once for each instruction set and chosen at run time. Plain
// data only: this header is read by code of every instruction set, so nothing inline in it may be called from two of
// them.
#pragma once

#include <cstddef>
#include <cstdint>

#include "cpu_shaders/runtime/shader_abi.h"
#include "raster/tiled/triangle.h"

namespace twinshade::tiled {

// Order of pixels in a tile's memory: superblocks of 16 x 16 by rows; in each, blocks of 4 x 4 by rows; in each, 2 x 2
// quads by rows; in each, (x,y) (x+1,y) (x,y+1) (x+1,y+1). So a quad, two quads and a block are 4, 8 and 16 neighbours
// in memory.
inline constexpr std::uint32_t kSuperblock = 16;
inline constexpr std::uint32_t kNotVisible = 0xffffffffu;

// Vertices to window space.
struct TransformVertices {
  const float* clip_positions;  // 4 a vertex
  std::size_t count;
  Viewport viewport;
  WindowVertex* vertices;     // out
  WindowPosition* positions;  // out, or null
};

// Triangles, for coverage.
inline constexpr std::uint32_t kSetUpAtOnce = 16;
struct SetUpTriangles {
  const WindowVertex* vertices;
  const std::uint32_t* indices;  // 3 a triangle
  std::uint32_t count;           // 1 to kSetUpAtOnce
  std::uint32_t frame_width, frame_height;
  bool cull_back_faces;
  // Out, with room for kSetUpAtOnce: the visible ones, in order; `primitive` is 0.
  RasterTriangle* triangles;
};
// Bit i: triangle i.
struct TriangleMasks {
  // Wholly within the view volume and over a pixel centre of the frame. Not those of zero area, culled, between
  // centres, or beyond kSnapLimit.
  std::uint32_t visible;
  std::uint32_t cut;    // by the view volume's planes
  std::uint32_t front;  // counter-clockwise
};

// A primitive (exact attributes) or a triangle (native ones: clipping may make several of a primitive) in a tile.
struct LocalPrimitive {
  std::uint32_t primitive;
  const NativeTriangle* native;  // null with exact attributes
  const float* clipped_inputs;   // of the native triangle's chunk
};

// Vertex data as the arithmetic of shaders/exact/attributes.glsl reads it.
struct VertexData {
  const float* clip_positions;   // 4 a vertex
  const std::uint32_t* indices;  // 3 a primitive
  const float* inputs;           // input_components a vertex
  std::uint32_t input_components;
  float ndc_scale_x, ndc_scale_y;  // 2 / viewport: ndc = pixel centre * scale - 1, exactly
};

// Where a primitive or a triangle shows in a 4 x 4 block.
struct VisibleBlock {
  std::uint32_t local;     // index into the tile's LocalPrimitives; while a tile is covered, of its triangles
  std::uint16_t block;     // index in the tile's memory / 16
  std::uint16_t coverage;  // bit i: pixel i of the block
};

// Triangles of a tile that follow each other, kTrianglesTogether of them or, at the end, what is left.
struct TriangleGroup {
  float nearest;  // the least RasterTriangle::nearest
  std::uint32_t first;
};
inline constexpr std::uint32_t kTrianglesTogether = 16;

// Triangles of one tile in primitive order.
struct CoverTile {
  const RasterTriangle* const* triangles;
  const std::uint32_t* locals;  // of each, index into the tile's LocalPrimitives
  std::uint32_t count;
  const TriangleGroup* groups;  // all triangles, in the order in which they are to be covered: by their groups' nearest
  std::uint32_t group_count;
  const LocalPrimitive* primitives;
  const VertexData* vertices;
  std::uint32_t x, y, size;  // lower left pixel; tile size
  std::uint32_t frame_width, frame_height;
  float* depth;            // of the tile: +0 to 1
  std::uint32_t* visible;  // index into triangles (cover_one: into LocalPrimitives), or kNotVisible
  float* farthest;         // kFarthestRoom of them, 1 before anything is covered: see farthest_depths_kernel.h
  VisibleBlock* blocks;    // out: triangle by triangle, those that each may show in; room for kBlockRoom a pixel
};
// Of the 32 x 32 blocks of a tile of 128 pixels, row by row, with three more each way that windows of 4 x 4 blocks
// reach into.
inline constexpr std::uint32_t kFarthestStride = 36, kFarthestRoom = 35 * kFarthestStride;
// For each pixel of a tile: once blocks that show nothing are dropped there is no more than one a pixel, and the next
// triangle's take less than the other.
inline constexpr std::uint32_t kBlockRoom = 2;

// What a tile shows, once all its triangles are covered.
struct CollectVisible {
  const CoverTile* tile;        // its blocks become those in which their triangle shows, with their coverage
  std::uint32_t block_count;    // before
  std::uint32_t* primitive_id;  // out: of each pixel; or null
  std::uint32_t no_primitive;   // its value where nothing is visible
  float* color;                 // of the tile; zeros in blocks that are not filled
};

// Invocations of one primitive follow each other: a run, up to the next one's first.
struct ShadeRun {
  std::uint32_t local;  // index into the tile's LocalPrimitives
  std::uint32_t first;  // invocation
};

// Covered pixels of blocks, or their 2 x 2 quads, added to invocations.
struct AddCovered {
  const VisibleBlock* blocks;
  std::size_t block_count;
  std::uint32_t enough;            // invocations after which no further block is begun
  std::uint32_t* pixels;           // out: as Interpolate::pixels, with room for 32 past `enough`
  std::uint32_t* live;             // out, of quads: ~0u where a pixel is covered, else 0; room as for pixels
  ShadeRun* runs;                  // out: with room for as many
  const float* block_depths;       // 16 a block, or null
  float* depths;                   // out, unless that is null: of each invocation, room as for pixels
  std::uint32_t count, run_count;  // in and out
};

// Inputs of `count` invocations. Arrays are structures of arrays with room for 16 elements past `count`.
struct Interpolate {
  const std::uint32_t* pixels;  // of each invocation, index in the tile's memory
  std::uint32_t count;
  std::uint32_t tile_x, tile_y;   // the tile's lower left pixel, in the frame
  std::uint32_t superblocks_log;  // log2 of the tile's superblocks in a row
  const ShadeRun* runs;
  std::uint32_t run_count;
  const LocalPrimitive* primitives;
  const VertexData* vertices;
  const std::uint8_t* interpolation;  // Interpolation of each input component
  const std::uint8_t* scalars;        // Scalar of each
  bool native;
  std::uint32_t stride;
  void* center_x;  // scratch: pixel centres
  void* center_y;
  void* inputs;                 // real: float, or double for the float64 kernel
  void* frag_coord;             // real, or null
  std::uint32_t* front_facing;  // or null
};

// Colours of `count` invocations, which are in structures of arrays, to a tile's memory.
struct StoreColors {
  const float* channels[4];     // with room for 16 elements past `count`; null: 0
  const std::uint32_t* pixels;  // of each invocation, index in the tile's memory
  std::uint32_t count;
  float* color;  // of the tile: RGBA of each pixel
};

// A superblock of a tile, to the frame. Pointers are to its first pixel.
struct StoreSuperblock {
  const float* color;  // RGBA
  const float* depth;
  const std::uint32_t* primitive_id;
  float* to_color;
  float* to_depth;
  std::uint32_t* to_primitive_id;  // null: neither ids nor coverage
  std::uint8_t* to_coverage;       // 1 where the id is another than no_primitive, else 0
  std::uint32_t no_primitive;
  std::size_t width;  // of the frame
  bool aligned;       // in every row to_color is 32-byte aligned, to_depth and to_primitive_id 16
};

struct Kernels {
  Isa isa;
  Number number;
  void (*transform_vertices)(const TransformVertices&);
  TriangleMasks (*set_up_triangles)(const SetUpTriangles&);
  // Covers and depth-tests all triangles; leaves depth, visible and blocks. Returns how many blocks there are.
  std::uint32_t (*cover)(const CoverTile&);
  // Covers triangle `which` alone: blocks, and 16 depths each, with room for all of a tile. With early_depth_test,
  // pixels that fail it now are left out. Returns how many blocks there are; one more may have been written.
  std::uint32_t (*cover_one)(const CoverTile&, std::uint32_t which, bool early_depth_test, VisibleBlock* blocks,
                             float* depths);
  // Returns how many blocks are left.
  std::uint32_t (*collect_visible)(const CollectVisible&);
  // Return how many blocks they took. The first adds covered pixels, the second quads that have some.
  std::size_t (*add_covered)(AddCovered&);
  std::size_t (*add_quads)(AddCovered&);
  void (*interpolate)(const Interpolate&);
  void (*store_colors)(const StoreColors&);
  // Stores go past the caches: a fence must follow the last one.
  void (*store_superblock)(const StoreSuperblock&);
};

// Coverage and depth are those of float whatever the number; float64 differs in `interpolate` only.
const Kernels& choose_kernels(Isa isa, Number number);

}  // namespace twinshade::tiled
