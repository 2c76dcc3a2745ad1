// OpenGL on the CPU or GPU, each draw in a worker process of our own binary with its own environment and time limit.
#pragma once

#include <array>

#include "raster/renderer.h"

namespace twinshade {

// egl, osmesa: llvmpipe. gpu: a graphics card's own driver, through EGL; how far it may differ from the processor is
// told in docs/graphics-cards.md.
enum class GlBackend : std::uint8_t { egl, osmesa, softpipe, gpu };

struct GlEnvironment {
  int threads = 0;       // LP_NUM_THREADS; 0: as thread_count()
  bool host_fma = true;  // false: GALLIUM_OVERRIDE_CPU_CAPS=sse4.1
  // / sqrt min max clamp as shaders/exact/written_out.glsl has them, not as the driver does: for graphics cards, whose
  // own are not exact. Not with native attributes, nor in compute shaders, which keep denormals.
  bool written_out = false;
  std::vector<std::pair<std::string, std::string>> extra;  // further variables for the worker
};

// Does not start anything yet. softpipe: shading only; draw() needs `cpu_frame` with captured attributes, see
// shade_on_softpipe.
std::unique_ptr<Renderer> make_gl_renderer(GlBackend backend, const GlEnvironment& environment = {});

// Shades on softpipe the pixels that cpu_frame covers, from cpu_frame.attributes (captured). Other pixels stay as
// cleared. output: as DrawOptions::output.
Frame shade_on_softpipe(const Bundle& bundle, const ShaderSource& source, const Frame& cpu_frame,
                        const GlEnvironment& environment, double time_limit_seconds, std::uint32_t output = 0);

// Runs a compute shader of GLSL 430 or later, or ES 310, on llvmpipe over `groups` work groups, with the bundle's
// uniforms, textures and buffers, and gives back the bundle's storage buffers as it left them. Errors as those of a
// draw.
std::vector<Buffer> dispatch_on_gl(GlBackend backend, const Bundle& bundle, const ShaderSource& source,
                                   const std::array<std::uint32_t, 3>& groups, const GlEnvironment& environment = {},
                                   double time_limit_seconds = 60);

// To be called first thing in main(): if this process was started as a worker, serves the parent and returns its exit
// code.
std::optional<int> run_gl_worker_if_asked(int argc, char** argv);

}  // namespace twinshade
