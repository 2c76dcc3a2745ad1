#include "raster/gl/protocol.h"

namespace twinshade::gl {

std::uint64_t storage_bytes(const ImageIndex& image) {
  std::uint64_t bytes = 0;
  for (const ImageBuffer& b : image.buffers)
    if (b.storage) bytes += (b.size + 63) / 64 * 64;
  return bytes;
}

namespace {

// Appends a part of so many bytes; where it begins.
std::uint64_t add_part(FrameLayout& layout, std::uint64_t bytes) {
  const std::uint64_t offset = layout.size;
  layout.size += (bytes + 63) / 64 * 64;
  return offset;
}

}  // namespace

FrameLayout frame_layout(std::uint64_t pixels, std::uint64_t components, bool full_screen) {
  FrameLayout layout;
  layout.color = add_part(layout, pixels * 16);
  layout.depth = add_part(layout, pixels * 4);
  layout.id = add_part(layout, pixels * 4);
  if (full_screen) {
    layout.cpu_id = add_part(layout, pixels * 4);
    layout.cpu_attributes = add_part(layout, pixels * 4 * components);
  } else {
    layout.attributes = add_part(layout, pixels * 4 * components);
  }
  return layout;
}

FrameLayout row_layout(std::uint64_t pixels, std::uint64_t components, std::uint64_t results) {
  FrameLayout layout;
  layout.cpu_attributes = add_part(layout, pixels * 4 * components);
  layout.attributes = add_part(layout, pixels * 4 * results);
  return layout;
}

void DrawRequest::write(WireWriter& out) const {
  for (const std::uint32_t count : groups) out.put(count);
  out.put(width), out.put(height), out.put(cull_back_faces), out.put(geometry);
  out.put(leaves), out.put(components), out.put(results);
  out.put(frame), out.put(captures), out.put(timed), out.put(prepass);
  out.put(timing), out.put(prepass_wanted), out.put(repeat), out.put(warmup), out.put(time_limit_seconds);
  out.put(uniforms), out.put(initialized), out.put(new_image), out.put(image);
}

void DrawRequest::read(WireReader& in) {
  for (std::uint32_t& count : groups) in.get(count);
  in.get(width), in.get(height), in.get(cull_back_faces), in.get(geometry);
  in.get(leaves), in.get(components), in.get(results);
  in.get(frame), in.get(captures), in.get(timed), in.get(prepass);
  in.get(timing), in.get(prepass_wanted), in.get(repeat), in.get(warmup), in.get(time_limit_seconds);
  in.get(uniforms), in.get(initialized), in.get(new_image), in.get(image);
}

}  // namespace twinshade::gl
