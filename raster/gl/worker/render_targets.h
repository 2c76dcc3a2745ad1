// The textures that a frame is drawn into.
#pragma once

#include <cstdint>
#include <vector>

#include "raster/gl/worker/gl_functions.h"

namespace twinshade::gl {

class RenderTargets {
 public:
  RenderTargets(const GlFunctions& gl, std::uint32_t width, std::uint32_t height);
  ~RenderTargets();
  RenderTargets(const RenderTargets&) = delete;
  RenderTargets& operator=(const RenderTargets&) = delete;

  bool fits(std::uint32_t width, std::uint32_t height) const { return width == width_ && height == height_; }
  // Each makes its framebuffer current, and cleared: colour and captures 0, ids all ones, depth 1.
  void begin_frame();
  void begin_color();
  void begin_capture(std::uint32_t targets);
  // From the framebuffer made current last.
  void read_color(void* rgba_f32) const;
  void read_id(void* r32ui) const;
  void read_depth(void* f32) const;
  void read_capture(std::uint32_t target, void* rgba32ui) const;

 private:
  GLuint texture(GLenum internal_format, GLenum format, GLenum type);
  GLuint framebuffer(const std::vector<GLuint>& colors);
  void read(GLenum attachment, GLenum format, GLenum type, void* pixels) const;
  void clear_depth();

  const GlFunctions& gl_;
  const std::uint32_t width_, height_;
  std::vector<GLuint> textures_, framebuffers_;
  GLuint depth_ = 0, frame_ = 0, color_only_ = 0, capture_ = 0;
};

}  // namespace twinshade::gl
