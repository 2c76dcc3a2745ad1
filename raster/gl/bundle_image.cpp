#include "raster/gl/bundle_image.h"

#include <cmath>

namespace twinshade::gl {
namespace {

struct Part {
  std::uint64_t offset;
  const void* bytes;
  std::size_t size;
};

// A triangle with a position that is not finite has no defined place on the screen: drivers may draw anything or crash,
// so it is drawn as a point-sized nothing, keeping the primitive ids of the others.
std::vector<std::uint32_t> drawn_indices(const Bundle& bundle) {
  std::vector<bool> finite(bundle.vertex_count());
  for (std::size_t v = 0; v < finite.size(); ++v) {
    finite[v] = true;
    for (std::size_t c = 0; c < 4; ++c) finite[v] = finite[v] && std::isfinite(bundle.clip_positions[v * 4 + c]);
  }
  std::uint32_t first_finite = 0;
  while (first_finite < finite.size() && !finite[first_finite]) ++first_finite;
  std::vector<std::uint32_t> drawn = bundle.indices;
  if (first_finite == finite.size()) return {};
  for (std::size_t i = 0; i + 2 < drawn.size(); i += 3)
    if (!finite[drawn[i]] || !finite[drawn[i + 1]] || !finite[drawn[i + 2]])
      drawn[i] = drawn[i + 1] = drawn[i + 2] = first_finite;
  return drawn;
}

}  // namespace

bool BundleImage::update(const Bundle& bundle) {
  ImageIndex index;
  std::vector<Part> parts;
  std::uint64_t size = 0;
  const auto place = [&](const void* bytes, std::size_t count, std::uint64_t alignment) {
    size = (size + alignment - 1) / alignment * alignment;
    const std::uint64_t offset = size;
    parts.push_back({offset, bytes, count});
    size += count;
    return offset;
  };

  // Vertex data in one piece: positions, then every attribute.
  index.vertex_count = bundle.vertex_count();
  index.vertices = place(bundle.clip_positions.data(), bundle.clip_positions.size() * 4, 64);
  index.vertex_floats = bundle.clip_positions.size();
  for (const Attribute& attribute : bundle.attributes) {
    index.attributes.push_back({attribute.name, attribute.components, index.vertex_floats});
    place(attribute.values.data(), attribute.values.size() * 4, 4);
    index.vertex_floats += attribute.values.size();
  }
  index.indices = place(bundle.indices.data(), bundle.indices.size() * 4, 64);
  const std::vector<std::uint32_t> drawn = drawn_indices(bundle);
  index.index_count = drawn.size();
  index.drawn_indices = drawn == bundle.indices ? index.indices : place(drawn.data(), drawn.size() * 4, 64);
  for (const Texture& t : bundle.textures)
    index.textures.push_back({t.name, t.kind, t.width, t.height, t.layers, t.filter, t.wrap,
                              place(t.texels.data(), t.texels.size() * 4, 64)});
  for (const Buffer& b : bundle.buffers)
    index.buffers.push_back({b.name, b.storage, place(b.bytes.data(), b.bytes.size(), 64), b.bytes.size()});

  WireWriter writer;
  writer.put(index);
  std::string index_bytes = writer.take();
  bool same = memory_.data() != nullptr && index_bytes == index_bytes_;
  for (const Part& part : parts) {
    if (!same) break;
    same = part.size == 0 || std::memcmp(memory_.data() + part.offset, part.bytes, part.size) == 0;
  }
  if (same) return false;

  memory_ = SharedMemory::create(std::max<std::uint64_t>(size, 64));
  for (const Part& part : parts)
    if (part.size != 0) std::memcpy(memory_.data() + part.offset, part.bytes, part.size);
  index_ = std::move(index);
  index_bytes_ = std::move(index_bytes);
  return true;
}

}  // namespace twinshade::gl
