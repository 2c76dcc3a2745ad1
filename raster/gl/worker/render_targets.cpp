#include "raster/gl/worker/render_targets.h"

#include <stdexcept>
#include <string>

#include "raster/gl/protocol.h"

namespace twinshade::gl {

RenderTargets::RenderTargets(const GlFunctions& gl, std::uint32_t width, std::uint32_t height)
    : gl_(gl), width_(width), height_(height) {
  depth_ = texture(GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT);
  const GLuint color = texture(GL_RGBA32F, GL_RGBA, GL_FLOAT);
  const GLuint id = texture(GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT);
  frame_ = framebuffer({color, id});
  color_only_ = framebuffer({color});
}

RenderTargets::~RenderTargets() {
  gl_.DeleteFramebuffers(GLsizei(framebuffers_.size()), framebuffers_.data());
  gl_.DeleteTextures(GLsizei(textures_.size()), textures_.data());
}

GLuint RenderTargets::texture(GLenum internal_format, GLenum format, GLenum type) {
  GLuint name = 0;
  gl_.GenTextures(1, &name);
  textures_.push_back(name);
  gl_.ActiveTexture(GL_TEXTURE0);
  gl_.BindTexture(GL_TEXTURE_2D, name);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
  gl_.TexImage2D(GL_TEXTURE_2D, 0, GLint(internal_format), GLsizei(width_), GLsizei(height_), 0, format, type, nullptr);
  check_errors(gl_, "making a " + std::to_string(width_) + "x" + std::to_string(height_) + " render target");
  gl_.BindTexture(GL_TEXTURE_2D, 0);
  return name;
}

GLuint RenderTargets::framebuffer(const std::vector<GLuint>& colors) {
  GLuint name = 0;
  gl_.GenFramebuffers(1, &name);
  framebuffers_.push_back(name);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, name);
  std::vector<GLenum> attachments;
  for (const GLuint color : colors) {
    attachments.push_back(GL_COLOR_ATTACHMENT0 + GLenum(attachments.size()));
    gl_.FramebufferTexture2D(GL_FRAMEBUFFER, attachments.back(), GL_TEXTURE_2D, color, 0);
  }
  gl_.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth_, 0);
  gl_.DrawBuffers(GLsizei(attachments.size()), attachments.data());
  if (gl_.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw std::runtime_error("the driver cannot render to these formats (framebuffer incomplete)");
  return name;
}

void RenderTargets::clear_depth() {
  const GLfloat far_plane = 1.0f;
  gl_.ClearBufferfv(GL_DEPTH, 0, &far_plane);
}

void RenderTargets::begin_frame() {
  gl_.BindFramebuffer(GL_FRAMEBUFFER, frame_);
  const GLfloat black[4] = {};
  const GLuint nothing[4] = {0xffffffffu, 0xffffffffu, 0xffffffffu, 0xffffffffu};
  gl_.ClearBufferfv(GL_COLOR, 0, black);
  gl_.ClearBufferuiv(GL_COLOR, 1, nothing);
  clear_depth();
}

void RenderTargets::begin_color() {
  gl_.BindFramebuffer(GL_FRAMEBUFFER, color_only_);
  const GLfloat black[4] = {};
  gl_.ClearBufferfv(GL_COLOR, 0, black);
  clear_depth();
}

void RenderTargets::begin_capture(std::uint32_t targets) {
  if (capture_ == 0) {
    std::vector<GLuint> textures;
    for (std::uint32_t i = 0; i < kCaptureTargets; ++i)
      textures.push_back(texture(GL_RGBA32UI, GL_RGBA_INTEGER, GL_UNSIGNED_INT));
    capture_ = framebuffer(textures);
  }
  gl_.BindFramebuffer(GL_FRAMEBUFFER, capture_);
  std::vector<GLenum> attachments;
  for (std::uint32_t i = 0; i < targets; ++i) attachments.push_back(GL_COLOR_ATTACHMENT0 + i);
  gl_.DrawBuffers(GLsizei(attachments.size()), attachments.data());
  const GLuint zero[4] = {};
  for (std::uint32_t i = 0; i < targets; ++i) gl_.ClearBufferuiv(GL_COLOR, GLint(i), zero);
  clear_depth();
}

void RenderTargets::read(GLenum attachment, GLenum format, GLenum type, void* pixels) const {
  gl_.PixelStorei(GL_PACK_ALIGNMENT, 4);
  gl_.ReadBuffer(attachment);
  gl_.ReadPixels(0, 0, GLsizei(width_), GLsizei(height_), format, type, pixels);
}

void RenderTargets::read_color(void* rgba_f32) const { read(GL_COLOR_ATTACHMENT0, GL_RGBA, GL_FLOAT, rgba_f32); }
void RenderTargets::read_id(void* r32ui) const { read(GL_COLOR_ATTACHMENT1, GL_RED_INTEGER, GL_UNSIGNED_INT, r32ui); }
void RenderTargets::read_depth(void* f32) const { read(GL_COLOR_ATTACHMENT0, GL_DEPTH_COMPONENT, GL_FLOAT, f32); }
void RenderTargets::read_capture(std::uint32_t target, void* rgba32ui) const {
  read(GL_COLOR_ATTACHMENT0 + target, GL_RGBA_INTEGER, GL_UNSIGNED_INT, rgba32ui);
}

}  // namespace twinshade::gl
