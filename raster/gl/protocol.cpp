#include "raster/gl/protocol.h"

namespace twinshade::gl {

FrameLayout frame_layout(std::uint64_t pixels, std::uint64_t components, bool full_screen) {
  FrameLayout layout;
  const auto part = [&](std::uint64_t bytes) {
    const std::uint64_t offset = layout.size;
    layout.size += (bytes + 63) / 64 * 64;
    return offset;
  };
  layout.color = part(pixels * 16);
  layout.depth = part(pixels * 4);
  layout.id = part(pixels * 4);
  if (full_screen) {
    layout.cpu_id = part(pixels * 4);
    layout.cpu_attributes = part(pixels * 4 * components);
  } else {
    layout.attributes = part(pixels * 4 * components);
  }
  return layout;
}

void DrawRequest::write(WireWriter& out) const {
  out.put(width), out.put(height), out.put(cull_back_faces), out.put(geometry);
  out.put(leaves), out.put(components);
  out.put(frame), out.put(captures), out.put(timed), out.put(prepass);
  out.put(timing), out.put(prepass_wanted), out.put(repeat), out.put(warmup), out.put(time_limit_seconds);
  out.put(uniforms), out.put(new_image), out.put(image);
}

void DrawRequest::read(WireReader& in) {
  in.get(width), in.get(height), in.get(cull_back_faces), in.get(geometry);
  in.get(leaves), in.get(components);
  in.get(frame), in.get(captures), in.get(timed), in.get(prepass);
  in.get(timing), in.get(prepass_wanted), in.get(repeat), in.get(warmup), in.get(time_limit_seconds);
  in.get(uniforms), in.get(new_image), in.get(image);
}

}  // namespace twinshade::gl
