// Where things lie in memory: uniforms outside blocks by std140's rules (GLSL 4.50, section 7.6.2.2 of the OpenGL
// specification), blocks by the decorations that glslang computed.
#pragma once

#include "cpu_shaders/translate/spirv_module.h"

namespace twinshade::spirv {

struct MatrixLayout {
  std::uint32_t stride = 16;
  bool row_major = false;
};

class Layout {
 public:
  // decorated: a block's; otherwise std140 of our own.
  Layout(const Module& module, bool decorated) : module_(&module), decorated_(decorated) {}

  std::uint32_t member_offset(Id structure, std::uint32_t index) const;
  MatrixLayout member_matrix(Id structure, std::uint32_t index) const;
  std::uint32_t array_stride(Id array) const;
  // Bytes from the start to the end of the last thing in it; a runtime-sized array counts as empty.
  std::uint32_t size(Id type, const MatrixLayout& matrix = {}) const;

 private:
  std::uint32_t alignment(Id type) const;
  const Module* module_;
  bool decorated_;
};

}  // namespace twinshade::spirv
