// The bundle on the driver's side: buffers and textures made from the shared image, and their binding to a program by
// name.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "raster/gl/protocol.h"
#include "raster/gl/shared_memory.h"
#include "raster/gl/worker/program.h"

namespace twinshade::gl {

class DrawData {
 public:
  explicit DrawData(const GlFunctions& gl);
  void replace(ImageIndex index, SharedMemory memory);

  // Pixels that the CPU wrote (Geometry::full_screen; without ids: Geometry::rows), as integer textures.
  void set_cpu_pixels(std::uint32_t width, std::uint32_t height, std::uint32_t components, const std::byte* ids,
                      const std::byte* attributes);

  // Vertex buffer, index buffer and, for Geometry::attributes, a vertex attribute per leaf.
  void bind_geometry(const DrawRequest& request);
  // Makes the program current with its uniforms, textures and blocks. Failure user_error naming what the bundle lacks.
  void bind(const Program& program, const DrawRequest& request);
  // Storage buffers that a draw may have written get the bundle's content back.
  void restore_storage();

  // The storage buffers as they are now, laid out as storage_bytes counts.
  void read_storage(std::byte* to);
  const ImageIndex& index() const { return index_; }

  std::uint64_t index_count() const { return index_.index_count; }

 private:
  const ImageAttribute& attribute(const std::string& name) const;
  void bind_uniform(const ActiveUniform& uniform, const DrawRequest& request);
  bool bind_own_uniform(const ActiveUniform& uniform, const DrawRequest& request);
  void bind_sampler(const ActiveUniform& uniform);
  void filter_edges(const ImageTexture& cube);
  void bind_buffer(const ActiveBlock& block, bool storage, GLuint binding);
  GLuint texture(const ImageTexture& texture);
  GLuint buffer(const ImageBuffer& buffer);
  void view_buffer(GLuint view, GLenum format, GLuint buffer);
  void bind_view(GLint location, GLuint view, std::uint64_t texels);
  void bind_unit(GLint location, GLenum target, GLuint name);

  const GlFunctions& gl_;
  ImageIndex index_;
  SharedMemory memory_;
  GLuint vertex_array_ = 0;
  GLuint vertices_ = 0, indices_ = 0, drawn_indices_ = 0;
  GLuint position_view_ = 0, vertex_view_ = 0, index_view_ = 0;  // buffer textures over vertices_ and indices_
  std::map<std::string, GLuint> textures_, buffers_;
  std::set<std::string> written_;  // storage buffers bound since they were last filled
  GLuint cpu_ids_ = 0, cpu_attributes_ = 0;
  GLint next_unit_ = 0;
  std::optional<bool> seamless_;  // of the cube maps bound so far
  GLint most_buffer_texels_ = 0;
  std::uint32_t enabled_attributes_ = 0;
};

}  // namespace twinshade::gl
