// A fragment shader over the rows of a table, on OpenGL: every row is one fragment of a grid, its inputs read from a
// texture, what the shader leaves in its outputs captured by bit cast.
#pragma once

#include "raster/gl/gl_renderer.h"
#include "raster/row_grid.h"

namespace twinshade {

struct FragmentRows {
  std::size_t rows = 0;  // 1 to kMostGridRows
  std::vector<Attribute>
      inputs;        // by leaf: "v_uv", "c[3]" of an array, "m[1]" of a matrix; `rows` times `components` values each
  Bundle resources;  // uniforms, textures and buffers; the rest is not looked at
};

struct RowResults {
  // One per component, "colour.x", "a[1].y": outputs in order of declaration, then gl_FragDepth where the shader writes
  // it.
  std::vector<std::string> names;
  std::vector<std::uint32_t> bits;  // [component * rows + row]; floats and integers by bit pattern; 0 in discarded rows
  std::vector<std::uint8_t> kept;   // by row: 0 where the shader discarded
  std::vector<std::pair<std::string, std::string>> provenance;
};

class RowRenderer {
 public:
  virtual ~RowRenderer() = default;
  // From one thread at a time. UserError where the driver rejects the shader or something it reads is missing;
  // BackendError where the backend cannot run it: missing, crashed, over the time limit.
  virtual RowResults run(const FragmentRows& table, const ShaderSource& source, double time_limit_seconds) = 0;
  // The backend is there: a worker has had a context to draw with.
  virtual bool started() const = 0;
};

// The worker starts when it is first needed, lives until the renderer goes, and starts anew where it died.
std::unique_ptr<RowRenderer> make_gl_row_renderer(GlBackend backend, const GlEnvironment& environment = {});

}  // namespace twinshade
