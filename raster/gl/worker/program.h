// A linked program and what it wants to have bound.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "raster/gl/protocol.h"
#include "raster/gl/worker/gl_functions.h"

namespace twinshade::gl {

struct ActiveUniform {  // outside blocks; arrays of basic types once
  std::string name;     // without a last "[0]"
  GLint location;
  GLenum type;
  GLint size;
  bool array;
};

struct ActiveBlock {
  std::string name;
  GLuint index;
  GLint bytes;  // at least
};

class Program {
 public:
  // Failure glsl_error with the log where the fragment or compute shader is rejected; std::runtime_error where our
  // vertex shader is or the two do not link.
  Program(const GlFunctions& gl, const ProgramText& text);
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  GLuint id() const { return id_; }
  const std::vector<ActiveUniform>& uniforms() const { return uniforms_; }
  const std::vector<ActiveBlock>& uniform_blocks() const { return uniform_blocks_; }
  const std::vector<ActiveBlock>& storage_blocks() const { return storage_blocks_; }

 private:
  void find_uniforms();
  void find_blocks();
  std::string name_buffer(GLenum longest) const;
  const GlFunctions& gl_;
  GLuint id_ = 0;
  std::vector<ActiveUniform> uniforms_;
  std::vector<ActiveBlock> uniform_blocks_, storage_blocks_;
};

// Compiled programs by their text and by which uniforms keep the values that the shader gives them: a program never
// forgets what was set.
class ProgramCache {
 public:
  explicit ProgramCache(const GlFunctions& gl) : gl_(gl) {}
  const Program& get(const ProgramText& text, const std::vector<std::string>& untouched);

 private:
  const GlFunctions& gl_;
  std::map<std::string, std::unique_ptr<Program>> programs_;
};

}  // namespace twinshade::gl
