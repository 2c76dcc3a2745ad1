// Clipping, setup and binning of all primitives (sort-middle with tile bins; Molnar et al., A sorting classification of
// parallel rendering, 1994). Chunks of primitives in parallel; each tile's bin is in primitive order whatever the
// threads do.
#include <algorithm>
#include <array>
#include <bit>
#include <utility>

#include "base/error.h"
#include "base/parallel.h"
#include "cpu_shaders/runtime/denormals.h"
#include "raster/tiled/clip.h"
#include "raster/tiled/geometry.h"

namespace twinshade::tiled {
namespace {

constexpr std::size_t kVerticesAtOnce = 4096;
constexpr std::size_t kTrianglesAtOnce = 1024;
constexpr std::size_t kMostChunks = std::size_t{1} << (32 - TriangleRef::kIndexBits);
constexpr std::size_t kMostTileCounts = std::size_t{1} << 22;  // over all chunks: 16 MiB

std::size_t divide_up(std::size_t a, std::size_t b) { return (a + b - 1) / b; }

// Whether some point of the tile is inside each edge.
bool may_touch(const RasterTriangle& t, std::uint32_t column, std::uint32_t row, std::uint32_t tile_size) {
  const std::int64_t x0 = std::int64_t(column) * tile_size, x1 = x0 + tile_size - 1;
  const std::int64_t y0 = std::int64_t(row) * tile_size, y1 = y0 + tile_size - 1;
  for (int i = 0; i < 3; ++i)
    if (t.c[i] + t.a[i] * (t.a[i] > 0 ? x1 : x0) + t.b[i] * (t.b[i] > 0 ? y1 : y0) < 0) return false;
  return true;
}

// What one chunk's primitives need, and where they go.
class ChunkSetup {
 public:
  ChunkSetup(const Bundle& bundle, const BoundDraw& draw, AttributeMode mode, const Kernels& kernels,
             const TileGrid& grid, const Geometry& geometry, TriangleChunk& chunk)
      : bundle_(bundle),
        draw_(draw),
        native_(mode == AttributeMode::native),
        kernels_(kernels),
        grid_(grid),
        tile_shift_(std::countr_zero(grid.tile_size)),
        geometry_(geometry),
        chunk_(chunk),
        viewport_(make_viewport(bundle.width, bundle.height)) {}

  void run(std::size_t begin, std::size_t end) {
    chunk_.native.clear();
    chunk_.clipped_inputs.clear();
    chunk_.references.clear();
    chunk_.tile_counts.assign(grid_.count(), 0);
    for (std::size_t first = begin; first < end; first += kSetUpAtOnce)
      add_primitives(std::uint32_t(first), std::uint32_t(std::min<std::size_t>(end - first, kSetUpAtOnce)));
    TWINSHADE_CHECK_LT(used_, std::size_t{1} << TriangleRef::kIndexBits);
  }

 private:
  struct Corner {
    WindowVertex window;
    WindowPosition position;  // native attributes only
    std::uint32_t vertex;     // as NativeTriangle::vertex
  };

  Corner corner_of_vertex(std::uint32_t vertex) const {
    return {geometry_.vertices[vertex], native_ ? geometry_.positions[vertex] : WindowPosition{}, vertex};
  }

  // In their order, with what is left of those that are cut in their place.
  void add_primitives(std::uint32_t first, std::uint32_t count) {
    const std::uint32_t* index = &bundle_.indices[std::size_t(first) * 3];
    const TriangleMasks masks = set_up(geometry_.vertices.data(), index, count, room_for_triangles());
    if (masks.cut == 0) {  // they are where they belong
      for (std::uint32_t left = masks.visible; left != 0; left &= left - 1)
        add_visible(first, index, std::uint32_t(std::countr_zero(left)), masks.front);
      return;
    }
    RasterTriangle ready[kSetUpAtOnce];
    std::copy_n(room_for_triangles(), kSetUpAtOnce, ready);
    const RasterTriangle* next = ready;
    for (std::uint32_t left = masks.visible | masks.cut; left != 0; left &= left - 1) {
      const std::uint32_t i = std::uint32_t(std::countr_zero(left));
      if (masks.cut >> i & 1) {
        add_clipped(first + i, index + 3 * i);
      } else {
        *room_for_triangles() = *next++;
        add_visible(first, index, i, masks.front);
      }
    }
  }

  // The triangle that is next in the chunk: primitive `first` + i, whole. front: as TriangleMasks has it.
  void add_visible(std::uint32_t first, const std::uint32_t* index, std::uint32_t i, std::uint32_t front) {
    add_triangle(first + i);
    if (native_)
      add_native((front >> i & 1) != 0, {corner_of_vertex(index[3 * i]), corner_of_vertex(index[3 * i + 1]),
                                         corner_of_vertex(index[3 * i + 2])});
  }

  // For kSetUpAtOnce more.
  RasterTriangle* room_for_triangles() {
    if (used_ + kSetUpAtOnce > chunk_.triangles.size()) chunk_.triangles.resize(2 * used_ + kTrianglesAtOnce);
    return &chunk_.triangles[used_];
  }

  TriangleMasks set_up(const WindowVertex* vertices, const std::uint32_t* indices, std::uint32_t count,
                       RasterTriangle* out) const {
    return kernels_.set_up_triangles(
        {vertices, indices, count, grid_.frame_width, grid_.frame_height, bundle_.cull_back_faces, out});
  }

  void add_clipped(std::uint32_t primitive, const std::uint32_t index[3]) {
    std::uint32_t outside = 0;
    for (int i = 0; i < 3; ++i) outside |= geometry_.vertices[index[i]].outside;
    float positions[12];
    for (int i = 0; i < 3; ++i) std::copy_n(&bundle_.clip_positions[std::size_t(index[i]) * 4], 4, positions + 4 * i);
    const ClippedTriangle clipped = clip_triangle(positions, outside);
    if (clipped.count < 3) return;
    const std::size_t first_row = native_ ? add_clipped_inputs(clipped, index) : 0;
    const auto corner = [&](std::uint8_t number) -> Corner {
      if (number < 3)
        return {geometry_.vertices[index[number]], to_window(positions + 4 * number, viewport_), index[number]};
      const WindowPosition position = to_window(clipped.added[number - 3].position, viewport_);
      return {snap(position, 0), position, kClippedVertex | std::uint32_t(first_row + number - 3)};
    };
    for (int i = 2; i < clipped.count; ++i) {  // the polygon's fan, its first vertex last, as Mesa emits it
      const std::array<Corner, 3> corners = {corner(clipped.polygon[std::size_t(i - 1)]),
                                             corner(clipped.polygon[std::size_t(i)]), corner(clipped.polygon[0])};
      if (bundle_.cull_back_faces && !faces_front(corners)) continue;
      WindowVertex window[3];
      for (std::size_t k = 0; k < 3; ++k) window[k] = {corners[k].window.x, corners[k].window.y, 0, 0};
      constexpr std::uint32_t kInOrder[3] = {0, 1, 2};
      const TriangleMasks masks = set_up(window, kInOrder, 1, room_for_triangles());
      if (masks.visible == 0) continue;
      add_triangle(primitive);
      if (native_) add_native(masks.front != 0, corners);
    }
  }

  // Mesa culls what it has clipped twice: in unsnapped positions, then in setup as everything. The first matters to
  // slivers.
  static bool faces_front(const std::array<Corner, 3>& corners) {
    const WindowPosition &p0 = corners[0].position, &p1 = corners[1].position, &p2 = corners[2].position;
    return (p0.x - p2.x) * (p1.y - p2.y) - (p0.y - p2.y) * (p1.x - p2.x) > 0;
  }

  // Shader inputs of the new vertices, by the same t as their positions. Returns the row of the first.
  std::size_t add_clipped_inputs(const ClippedTriangle& clipped, const std::uint32_t index[3]) {
    const std::size_t stride = draw_.input_components;
    const std::size_t first_row = stride ? chunk_.clipped_inputs.size() / stride : 0;
    chunk_.clipped_inputs.resize(chunk_.clipped_inputs.size() + stride * std::size_t(clipped.added_count));
    const auto row = [&](std::uint8_t number) {
      return number < 3 ? &draw_.vertex_inputs[index[number] * stride]
                        : &chunk_.clipped_inputs[(first_row + number - 3) * stride];
    };
    for (int k = 0; k < clipped.added_count && stride > 0; ++k) {
      const NewVertex& v = clipped.added[std::size_t(k)];
      const float* from = row(v.from);
      const float* to = row(v.to);
      float* out = &chunk_.clipped_inputs[(first_row + std::size_t(k)) * stride];
      const float linear_t = screen_space_t(clipped, index, v);
      for (std::size_t c = 0; c < stride; ++c) {
        const float t = draw_.interpolation[c] == Interpolation::linear ? linear_t : v.t;
        out[c] = from[c] + t * (to[c] - from[c]);
      }
    }
    return first_row;
  }

  // t for noperspective inputs: where the new vertex is between the two on the screen.
  float screen_space_t(const ClippedTriangle& clipped, const std::uint32_t index[3], const NewVertex& v) const {
    const auto position = [&](std::uint8_t number) {
      return number < 3 ? &bundle_.clip_positions[std::size_t(index[number]) * 4] : clipped.added[number - 3].position;
    };
    const float* from = position(v.from);
    const float* to = position(v.to);
    for (int k = 0; k < 2; ++k)
      if (from[k] != to[k]) {
        const float a = to[k] / to[3], b = from[k] / from[3], at = v.position[k] / v.position[3];
        return (at - b) / (a - b);
      }
    return v.t;
  }

  // The one that is next in the chunk.
  void add_triangle(std::uint32_t primitive) {
    RasterTriangle& triangle = chunk_.triangles[used_];
    triangle.primitive = primitive;
    add_references(triangle, std::uint32_t(used_++));
  }

  void add_native(bool front_facing, const std::array<Corner, 3>& corners) {
    NativeTriangle native;
    for (std::size_t i = 0; i < 3; ++i) {
      const Corner& from = corners[!front_facing && i < 2 ? 1 - i : i];
      native.position[i] = from.position;
      native.vertex[i] = from.vertex;
    }
    native.front_facing = front_facing ? ~0u : 0u;
    chunk_.native.push_back(native);
  }

  void add_references(const RasterTriangle& t, std::uint32_t index) {
    const std::uint32_t column0 = std::uint32_t(t.min_x) >> tile_shift_,
                        column1 = std::uint32_t(t.max_x) >> tile_shift_;
    const std::uint32_t row0 = std::uint32_t(t.min_y) >> tile_shift_, row1 = std::uint32_t(t.max_y) >> tile_shift_;
    if (((column0 ^ column1) | (row0 ^ row1)) == 0) {
      add_reference(row0 * grid_.columns + column0, index);
      return;
    }
    for (std::uint32_t row = row0; row <= row1; ++row)
      for (std::uint32_t column = column0; column <= column1; ++column)
        if (may_touch(t, column, row, grid_.tile_size)) add_reference(row * grid_.columns + column, index);
  }

  void add_reference(std::uint32_t tile, std::uint32_t index) {
    chunk_.references.push_back({tile, index});
    ++chunk_.tile_counts[tile];
  }

  const Bundle& bundle_;
  const BoundDraw& draw_;
  const bool native_;
  const Kernels& kernels_;
  const TileGrid& grid_;
  const int tile_shift_;
  const Geometry& geometry_;
  TriangleChunk& chunk_;
  const Viewport viewport_;
  std::size_t used_ = 0;  // of the chunk's triangles
};

// Of triangles to tiles. Bins begin at 32-bit numbers.
std::size_t count_references(const std::vector<TriangleChunk>& chunks) {
  std::size_t count = 0;
  for (const TriangleChunk& chunk : chunks) count += chunk.references.size();
  if (count > UINT32_MAX)
    throw UserError("triangles cover " + std::to_string(count) +
                    " tiles in all, of which 2^32 - 1 can be binned: ask "
                    "for larger tiles or a smaller frame");
  return count;
}

}  // namespace

TileGrid make_grid(std::uint32_t frame_width, std::uint32_t frame_height, int tile_size) {
  if (tile_size != 16 && tile_size != 32 && tile_size != 64 && tile_size != 128)
    throw UserError("tile size " + std::to_string(tile_size) + " is not 16, 32, 64 or 128");
  const auto size = std::uint32_t(tile_size);
  return {frame_width, frame_height, size, (frame_width + size - 1) / size, (frame_height + size - 1) / size};
}

void transform_vertices(const Bundle& bundle, AttributeMode mode, const Kernels& kernels, Geometry& geometry) {
  const std::size_t count = bundle.vertex_count();
  geometry.vertices.resize(count);
  geometry.positions.resize(mode == AttributeMode::native ? count : 0);
  const Viewport viewport = make_viewport(bundle.width, bundle.height);
  parallel_for(divide_up(count, kVerticesAtOnce), [&](std::size_t i, int) {
    const FlushDenormals flush;
    const std::size_t first = i * kVerticesAtOnce;
    kernels.transform_vertices({&bundle.clip_positions[4 * first], std::min(count - first, kVerticesAtOnce), viewport,
                                &geometry.vertices[first],
                                geometry.positions.empty() ? nullptr : &geometry.positions[first]});
  });
}

void set_up_and_bin(const Bundle& bundle, const BoundDraw& draw, AttributeMode mode, const Kernels& kernels,
                    const TileGrid& grid, Geometry& geometry) {
  const std::size_t triangles = bundle.triangle_count();
  const std::size_t chunk_count =
      std::clamp<std::size_t>(divide_up(triangles, kTrianglesAtOnce), 1,
                              std::min(kMostChunks, std::max<std::size_t>(1, kMostTileCounts / grid.count())));
  const std::size_t chunk_size = divide_up(triangles, chunk_count);
  geometry.chunks.resize(chunk_count);
  parallel_for(chunk_count, [&](std::size_t i, int) {
    const FlushDenormals flush;
    ChunkSetup(bundle, draw, mode, kernels, grid, geometry, geometry.chunks[i])
        .run(std::min(triangles, i * chunk_size), std::min(triangles, (i + 1) * chunk_size));
  });

  // Where each chunk's references to each tile begin: tile by tile, chunks in order within.
  geometry.bin_begin.resize(grid.count() + 1);
  std::uint32_t begin = 0;
  geometry.bins.resize(count_references(geometry.chunks));
  for (std::uint32_t tile = 0; tile < grid.count(); ++tile) {
    geometry.bin_begin[tile] = begin;
    for (TriangleChunk& chunk : geometry.chunks) begin += std::exchange(chunk.tile_counts[tile], begin);
  }
  geometry.bin_begin[grid.count()] = begin;
  parallel_for(chunk_count, [&](std::size_t i, int) {
    TriangleChunk& chunk = geometry.chunks[i];
    for (const TriangleChunk::Reference reference : chunk.references)
      geometry.bins[chunk.tile_counts[reference.tile]++].packed =
          std::uint32_t(i) << TriangleRef::kIndexBits | reference.triangle;
  });
}

}  // namespace twinshade::tiled
