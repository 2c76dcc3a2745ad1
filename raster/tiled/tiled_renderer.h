// The CPU renderer: clip, bin, cover, resolve visibility, shade. Depends on bundle, base and the shader ABI only, so
// that it also builds alone (AArch64).
#pragma once

#include <functional>

#include "base/error.h"
#include "raster/renderer.h"

namespace twinshade {

// What the shader declares and the bundle lacks, or has as another type. The module knows no lines: who has the source
// can say where `variable` is declared.
struct UnboundError : UserError {
  UnboundError(const std::string& shader, const std::string& name, const std::string& why)
      : UserError("shader \"" + shader + "\": " + why), variable(name), reason(why) {}
  std::string variable, reason;
};

// Draws with an already loaded module. Everything the CPU renderer does is here.
Frame draw_tiled(const Bundle& bundle, const ShaderModule& module, const DrawOptions& options);

// The Renderer interface over draw_tiled: `find_module` returns the module for a source (built-in, or translated,
// compiled and loaded on demand: see cpu_shaders/load/load.h).
std::unique_ptr<Renderer> make_tiled_renderer(
    std::function<const ShaderModule&(const ShaderSource&, Number, std::optional<Isa>)> find_module);

}  // namespace twinshade
