// Geometry to pixels: what both machines implement.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/line_vector.h"
#include "bundle/bundle.h"
#include "cpu_shaders/runtime/shader_abi.h"
#include "cpu_shaders/shader_source.h"

namespace twinshade {

// exact: attributes and depth from vertex data by the arithmetic of shaders/exact/attributes.glsl, on both machines.
// native: GL's ordinary varyings; on the CPU their closest model (plane equations). Differences are reported, not forbidden.
enum class AttributeMode : std::uint8_t { exact, native };

inline constexpr std::uint32_t kNoPrimitive = 0xffffffffu;

// Pixel (x, y) is at index y * width + x, y upwards as in OpenGL (row 0 at the bottom).
struct Frame {
  std::uint32_t width = 0, height = 0;
  LineVector<float> color;                 // RGBA32F of one output; 0 where nothing was drawn. Integers by bit pattern
  Scalar color_scalar = Scalar::f32;       // what they are
  LineVector<float> depth;                 // [0, 1]; 1 where nothing was drawn
  // Empty without DrawOptions::visibility.
  LineVector<std::uint32_t> primitive_id;  // kNoPrimitive where nothing was drawn
  LineVector<std::uint8_t> coverage;       // 1 where a primitive was drawn (after discard), else 0

  // Filled if DrawOptions::capture_attributes: the shader's inputs as it saw them, in the order of attribute_names, only
  // meaningful where coverage is 1. Planar: component c of pixel p at [c * width * height + p]; integers by bit pattern.
  std::vector<float> attributes;
  std::vector<std::string> attribute_names;  // one per component: "v_uv.x", "v_uv.y" ...
  std::vector<Scalar> attribute_scalars;     // one per component

  // Double evaluation (cpu with Number::float64): as color, unrounded.
  std::vector<double> color64;

  // Timings of the draw alone, milliseconds; per stage where the renderer knows ("vertex", "bin", "raster", "interpolate",
  // "shade", "store"). GL: "draw" only, measured around draw + glFinish.
  std::vector<std::pair<std::string, double>> milliseconds;

  std::vector<std::pair<std::string, std::string>> provenance;  // GL_RENDERER, GL_VERSION, isa, lanes, threads ...
  std::uint32_t distinct_threads = 0;  // cpu: threads that shaded at least one tile
};

struct DrawOptions {
  AttributeMode attributes = AttributeMode::exact;
  bool capture_attributes = false;
  std::uint32_t output = 0;    // location of what the frame's colour is; where nothing is at 0, the output declared first
  int repeat = 1;              // draw this many times (benchmark); milliseconds then holds the median of each stage
  int warmup = 0;
  // cpu only
  bool visibility = true;      // Frame::primitive_id and coverage; else they stay empty
  int tile_size = 0;           // 16, 32, 64 or 128; 0: the renderer chooses
  Number number = Number::lanes16;
  std::optional<Isa> isa;      // unset: the best that the machine and the module have
  // gl only
  double time_limit_seconds = 60;
  bool depth_prepass = false;  // benchmark: fill depth first, then shade with GL_EQUAL
};

// Why a backend cannot draw: library missing, driver crash, hang, unsupported feature, GLSL rejected. Names the backend.
class BackendError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// draw() may be called any number of times, from one thread at a time. UserError where the shader's inputs, textures, uniforms
// or buffers are not all in the bundle (naming the missing one and what the bundle has) or have other types.
class Renderer {
 public:
  virtual ~Renderer() = default;
  virtual std::string name() const = 0;  // "cpu", "egl", "osmesa", "softpipe", "gpu"
  virtual Frame draw(const Bundle& bundle, const ShaderSource& source, const DrawOptions& options) = 0;
};

// SHA-256 over size, coverage, ids, depth bits and colour bits, NaNs of floats made one (0x7fc00000).
std::string frame_hash(const Frame& frame);

}  // namespace twinshade
