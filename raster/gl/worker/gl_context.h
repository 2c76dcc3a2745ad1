// An OpenGL context without a window, made current for the life of the process.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "raster/gl/gl_renderer.h"
#include "raster/gl/worker/gl_functions.h"

namespace twinshade::gl {

class GlContext {
 public:
  virtual ~GlContext() = default;
  const GlFunctions& functions() const { return functions_; }
  std::vector<std::pair<std::string, std::string>> provenance() const;  // GL_RENDERER, GL_VERSION ...

 protected:
  using Procedure = void (*)();
  void load(Procedure (*get)(const char*));
  GlFunctions functions_;
};

// Mesa's surfaceless platform through EGL (egl, softpipe), a device of EGL's list (gpu: the first graphics card, or the
// device that TWINSHADE_GPU numbers from 0), or OSMesa. The library is libEGL.so.1 or libOSMesa.so.8, or what
// TWINSHADE_EGL_LIBRARY or TWINSHADE_OSMESA_LIBRARY names. std::runtime_error with the reason where there is none.
std::unique_ptr<GlContext> make_context(GlBackend backend);

}  // namespace twinshade::gl
